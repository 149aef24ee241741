//! Lists of values as they are written: `0:1:0.1`, `nearest,farthest`, `1,2,4`.

use crate::results::Scalar;

/// Most values of one axis.
const MOST: usize = 10_000;

/// Reads values separated by commas, each a number, a word, or a range
/// `START:STOP:STEP` that includes its ends.
///
/// # Errors
/// If a range is none, there are too many values, or one is written twice.
pub fn values(text: &str) -> Result<Vec<Scalar>, String> {
    let mut list: Vec<Scalar> = Vec::new();
    for item in text.split(',').map(str::trim) {
        let parts: Vec<&str> = item.split(':').map(str::trim).collect();
        match parts[..] {
            [""] => return Err(format!("a value is missing in \"{text}\"")),
            [one] => list.push(Scalar::read(one)),
            [start, stop, step] => list.extend(range(start, stop, step)?),
            _ => {
                return Err(format!(
                    "\"{item}\" is no range; write START:STOP:STEP, such as 0:1:0.1"
                ));
            }
        }
        if list.len() > MOST {
            return Err(format!("\"{text}\" is more than {MOST} values; take a larger step"));
        }
    }
    match repeated(&list) {
        Some(value) => Err(format!("{value} is in \"{text}\" twice; write it once")),
        None => Ok(list),
    }
}

/// Reads values of which each must be a number.
///
/// # Errors
/// As [`values`], or if one is a word.
pub fn numbers(text: &str) -> Result<Vec<f64>, String> {
    values(text)?.into_iter().map(|value| number(&value)).collect()
}

/// The number that a value is.
///
/// # Errors
/// If it is a word.
pub fn number(value: &Scalar) -> Result<f64, String> {
    match value {
        Scalar::Number(number) => Ok(*number),
        Scalar::Word(word) => Err(format!("\"{word}\" is not a number")),
    }
}

fn repeated(list: &[Scalar]) -> Option<&Scalar> {
    let mut texts: Vec<(String, &Scalar)> = list.iter().map(|v| (v.to_string(), v)).collect();
    texts.sort_by(|a, b| a.0.cmp(&b.0));
    texts.windows(2).find(|pair| pair[0].0 == pair[1].0).map(|pair| pair[1].1)
}

fn range(start: &str, stop: &str, step: &str) -> Result<Vec<Scalar>, String> {
    let read = |text: &str| {
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| {
            format!("\"{text}\" is not a number; write START:STOP:STEP, such as 0:1:0.1")
        })
    };
    let (from, to, by) = (read(start)?, read(stop)?, read(step)?);
    let steps = (to - from) / by;
    if !steps.is_finite() || steps < 0.0 {
        return Err(format!("{start} does not reach {stop} in steps of {step}"));
    }
    if steps >= MOST as f64 {
        return Err(format!(
            "{start}:{stop}:{step} is more than {MOST} values; take a larger step"
        ));
    }
    // A stop that rounding puts just out of reach belongs to the range.
    let last = (steps + 1e-9).floor() as usize;
    Ok((0..=last).map(|i| Scalar::Number(clean(from + i as f64 * by))).collect())
}

/// The number that twelve digits say: 0.3 and not 0.30000000000000004.
fn clean(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(numbers: &[f64]) -> Result<Vec<Scalar>, String> {
        Ok(numbers.iter().map(|number| Scalar::Number(*number)).collect())
    }

    #[test]
    fn a_range_has_both_its_ends_and_clean_numbers() {
        assert_eq!(values("0:1:0.25"), list(&[0.0, 0.25, 0.5, 0.75, 1.0]));
        assert_eq!(values("0:0.3:0.1"), list(&[0.0, 0.1, 0.2, 0.3]));
        assert_eq!(numbers("1.05:2.4:0.15").map(|n| (n.len(), n[9])), Ok((10, 2.4)));
        assert_eq!(values("3:1:-1,7"), list(&[3.0, 2.0, 1.0, 7.0]));
        // A step that does not divide the range ends before its stop.
        assert_eq!(values("0:1:0.4"), list(&[0.0, 0.4, 0.8]));
        assert_eq!(values("near, far").map(|list| list[1].to_string()), Ok("far".to_owned()));
    }

    #[test]
    fn what_is_no_list_says_what_to_write() {
        for (text, words) in [
            ("", "missing"),
            ("1,,2", "missing"),
            ("0:1", "START:STOP:STEP"),
            ("0:1:0", "does not reach"),
            ("0:1:-0.1", "does not reach"),
            ("a:1:0.1", "\"a\" is not a number"),
            ("0:1:1e-9", "more than 10000"),
            ("1,2,1", "1 is in"),
            ("0:1:inf", "not a number"),
        ] {
            let error = values(text).map(|_| ()).err().unwrap_or_default();
            assert!(error.contains(words), "{text}: {error}");
        }
        assert!(numbers("1,far").is_err() && numbers("1,2").is_ok());
    }
}
