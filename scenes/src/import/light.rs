//! `KHR_lights_punctual`: point and directional lights.
//!
//! The extension counts in candela and lux; the numbers are taken as radiant
//! intensity and irradiance in the unit in which the environment's radiance is
//! given, as everything else in a file is.

use super::{ImportError, Reader};
use crate::scene::Light;
use glam::{DMat4, DVec3};
use serde_json::Value;

impl Reader<'_> {
    /// Adds the light of a node, if it has one.
    pub(super) fn add_light(
        &mut self,
        node: &gltf::Node<'_>,
        world: DMat4,
    ) -> Result<(), ImportError> {
        const NAME: &str = "KHR_lights_punctual";
        let number = node.extension_value(NAME).and_then(|value| value.get("light")?.as_u64());
        let Some(number) = number else { return Ok(()) };
        let lights = self.document.extension_value(NAME).and_then(|value| value.get("lights"));
        let light = lights.and_then(|lights| lights.get(usize::try_from(number).ok()?));
        let Some(light) = light.cloned() else {
            return Err(self.wrong(NAME, &format!("there is no light {number}")));
        };
        let name = light.get("name").and_then(Value::as_str).unwrap_or("a light without a name");
        let place = format!("{NAME}, {name}");
        let strength = self.strength(&light, &place)?;
        match light.get("type").and_then(Value::as_str) {
            Some("directional") => {
                let direction = world.transform_vector3(DVec3::NEG_Z).normalize_or(DVec3::NEG_Z);
                let irradiance = strength;
                self.scene.lights.push(Light::Directional { direction, irradiance });
            }
            Some("point") => {
                let position_m = world.transform_point3(DVec3::ZERO);
                self.scene.lights.push(Light::Point { position_m, intensity: strength });
                if light.get("range").is_some() {
                    self.warn(format!("{place}: its range is not read: light falls off forever"));
                }
            }
            kind => {
                let kind = kind.unwrap_or("without a type");
                self.warn(format!("{place}: lights of type \"{kind}\" are not read"));
            }
        }
        Ok(())
    }

    /// Colour times intensity.
    fn strength(&self, light: &Value, place: &str) -> Result<DVec3, ImportError> {
        let number = |value: &Value| {
            let number = value.as_f64().filter(|n| n.is_finite() && *n >= 0.0);
            number.ok_or_else(|| self.wrong(place, &format!("{value} is no amount of light")))
        };
        let intensity = light.get("intensity").map_or(Ok(1.0), number)?;
        let mut colour = DVec3::ONE;
        for (channel, value) in light
            .get("color")
            .and_then(Value::as_array)
            .iter()
            .flat_map(|c| c.iter().take(3).enumerate())
        {
            colour[channel] = number(value)?;
        }
        Ok(colour * intensity)
    }
}
