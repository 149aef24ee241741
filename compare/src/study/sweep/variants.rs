//! Methods with the values of their parameters.

use super::{Axes, Knob, Sweep, Variant};
use crate::Error;
use crate::results::Scalar;
use crate::study::Spec;
use realtime::Method;
use realtime::methods::{Kind, Settings};
use std::collections::BTreeMap;

/// Every combination of one value of each list; one empty one if there is none.
pub(super) fn product<T: Clone>(lists: &[(&String, &Vec<T>)]) -> Vec<BTreeMap<String, T>> {
    lists.iter().fold(vec![BTreeMap::new()], |all, (name, values)| {
        let with = |one: &BTreeMap<String, T>, value: &T| {
            let mut one = one.clone();
            one.insert((*name).clone(), value.clone());
            one
        };
        let with = &with;
        all.iter().flat_map(|one| values.iter().map(move |value| with(one, value))).collect()
    })
}

/// Every method of a sweep with every combination of what is varied of it.
pub(super) fn variants(spec: &Spec, sweep: &Sweep, axes: &Axes) -> Result<Vec<Variant>, Error> {
    let methods: Vec<&String> = match &sweep.method {
        Some(method) => vec![method],
        None => spec.methods.iter().collect(),
    };
    let mut owned: Vec<(&Knob, String)> = Vec::new();
    for knob in &axes.param {
        match owner(knob, spec, sweep)? {
            Some(owner) => owned.push((knob, owner)),
            // A sweep of one method has nothing to do with another's knobs.
            None => continue,
        }
    }
    let supersampling =
        if axes.supersampling.is_empty() { vec![1] } else { axes.supersampling.clone() };
    let mut list = Vec::new();
    for id in methods {
        let own = owned.iter().filter(|(_, owner)| owner == id);
        let lists: Vec<_> = own.map(|(knob, _)| (&knob.name, &knob.values)).collect();
        let method = Method::find(id)?;
        for set in product(&lists) {
            let param = all_parameters(method, &set)?;
            let supersampling = supersampling.clone();
            list.push(Variant { method: id.clone(), set, param, supersampling });
        }
    }
    Ok(list)
}

/// The method that a knob turns, `None` if it turns none of this sweep.
fn owner(knob: &Knob, spec: &Spec, sweep: &Sweep) -> Result<Option<String>, Error> {
    let fail = |what: String| Err(Error::Usage(what));
    let has = |id: &str| -> Result<bool, Error> {
        Ok(Method::find(id)?.parameters.iter().any(|parameter| parameter.name == knob.name))
    };
    let known = |id: &str| -> Result<String, Error> {
        let names: Vec<_> = Method::find(id)?.parameters.iter().map(|p| p.name).collect();
        Ok(if names.is_empty() { "none".to_owned() } else { names.join(", ") })
    };
    if let Some(method) = &knob.method {
        let id = Method::find(method)?.id.to_owned();
        if !has(&id)? {
            return fail(format!(
                "{id} has no parameter \"{}\"; it has {}",
                knob.name,
                known(&id)?
            ));
        }
        if !spec.methods.contains(&id) {
            return fail(format!("{id}.{} is set, and {id} is not in the study", knob.name));
        }
        let here = sweep.method.as_ref().is_none_or(|method| *method == id);
        return Ok(here.then_some(id));
    }
    if let Some(method) = &sweep.method {
        let of_sweep = sweep.axes.param.contains(knob);
        if of_sweep && !has(method)? {
            let (name, there) = (&knob.name, known(method)?);
            return fail(format!("{method} has no parameter \"{name}\"; it has {there}"));
        }
        if of_sweep {
            return Ok(Some(method.clone()));
        }
    }
    let mut owners = Vec::new();
    for id in &spec.methods {
        if has(id)? {
            owners.push(id.clone());
        }
    }
    match &owners[..] {
        [] => fail(format!("no method of the study has a parameter \"{}\"", knob.name)),
        [one] => Ok(sweep.method.as_ref().is_none_or(|m| m == one).then(|| one.clone())),
        several => {
            let names: Vec<_> = several.iter().map(|id| format!("{id}.{}", knob.name)).collect();
            fail(format!(
                "\"{}\" is a parameter of several methods; write {}",
                knob.name,
                names.join(" or ")
            ))
        }
    }
}

/// Every parameter with its type, those that are not set at their defaults.
fn all_parameters(
    method: &Method,
    set: &BTreeMap<String, Scalar>,
) -> Result<BTreeMap<String, Scalar>, Error> {
    let text = set.iter().map(|(name, value)| (name.clone(), value.to_string())).collect();
    Ok(typed(method, &Settings::new(method, &text)?.describe()))
}

/// Parameters as numbers where they are numbers.
pub(in crate::study) fn typed(
    method: &Method,
    text: &BTreeMap<String, String>,
) -> BTreeMap<String, Scalar> {
    let is_number = |name: &str| {
        let parameter = method.parameters.iter().find(|parameter| parameter.name == name);
        parameter.is_some_and(|parameter| matches!(parameter.kind, Kind::Number { .. }))
    };
    let value = |name: &str, text: &String| match is_number(name) {
        true => Scalar::read(text),
        false => Scalar::Word(text.clone()),
    };
    text.iter().map(|(name, text)| (name.clone(), value(name, text))).collect()
}
