//! Materials of a glTF file as surfaces and media.

use super::{ImportError, Reader};
use crate::medium::RGB_WAVELENGTH_UM;
use crate::scene::Paint;
use crate::{Dispersion, Eta, Medium, MediumId, Surface};
use glam::DVec3;

impl Reader<'_> {
    pub(super) fn surface_of(
        &mut self,
        material: &gltf::Material<'_>,
    ) -> Result<Surface, ImportError> {
        let name = material.name().unwrap_or("a material without a name").to_owned();
        self.must_be_plain(material, &name)?;
        let transmission = material.transmission().map_or(0.0, |t| t.transmission_factor());
        if transmission == 0.0 {
            return self.opaque(material, &name);
        }
        if material.emissive_factor() != [0.0; 3] {
            let what = "glass that glows is not rendered; write emissiveFactor [0, 0, 0]";
            return Err(self.wrong(&name, what));
        }
        if transmission < 1.0 {
            let what = format!(
                "transmissionFactor {transmission} is neither glass nor opaque; write 1 or 0"
            );
            return Err(self.wrong(&name, &what));
        }
        self.must_be_clear(material, &name)?;
        let medium = self.medium_of(material)?;
        let known = self.scene.media.iter().position(|other| *other == medium);
        let index = known.unwrap_or(self.scene.media.len());
        if known.is_none() {
            self.scene.warnings.extend(medium.doubt());
            self.scene.media.push(medium);
        }
        Ok(Surface::Dielectric { medium: MediumId(index as u16), priority: 0 })
    }

    /// Nothing varies over the surface, nothing is see-through without being
    /// glass, nothing is metal.
    fn must_be_plain(
        &mut self,
        material: &gltf::Material<'_>,
        name: &str,
    ) -> Result<(), ImportError> {
        let pbr = material.pbr_metallic_roughness();
        let textures = [
            ("baseColorTexture", pbr.base_color_texture().is_some()),
            ("metallicRoughnessTexture", pbr.metallic_roughness_texture().is_some()),
            ("normalTexture", material.normal_texture().is_some()),
            ("emissiveTexture", material.emissive_texture().is_some()),
            (
                "transmissionTexture",
                material.transmission().is_some_and(|t| t.transmission_texture().is_some()),
            ),
            (
                "thicknessTexture",
                material.volume().is_some_and(|v| v.thickness_texture().is_some()),
            ),
        ];
        if material.occlusion_texture().is_some() {
            self.warn(format!("{name}: occlusionTexture is not read"));
        }
        if let Some((texture, _)) = textures.iter().find(|(_, there)| *there) {
            let what = format!("{texture} is not rendered; write the factor alone");
            return Err(self.wrong(name, &what));
        }
        if material.alpha_mode() != gltf::material::AlphaMode::Opaque {
            let what = "alphaMode other than OPAQUE is not rendered; for glass write \
                        KHR_materials_transmission";
            return Err(self.wrong(name, what));
        }
        if pbr.metallic_factor() > 0.0 {
            let what = format!(
                "metallicFactor {} (1 where it is not written) is not rendered; write \
                 \"metallicFactor\": 0",
                pbr.metallic_factor()
            );
            return Err(self.wrong(name, &what));
        }
        Ok(())
    }

    /// A smooth, colourless surface around a volume.
    fn must_be_clear(&self, material: &gltf::Material<'_>, name: &str) -> Result<(), ImportError> {
        let pbr = material.pbr_metallic_roughness();
        if pbr.roughness_factor() > 0.0 {
            let what = format!(
                "rough glass is not rendered and roughnessFactor is {} (1 where it is not \
                 written); write \"roughnessFactor\": 0",
                pbr.roughness_factor()
            );
            return Err(self.wrong(name, &what));
        }
        if pbr.base_color_factor()[..3] != [1.0; 3] {
            let what = "baseColorFactor would tint light at the surface, which clear glass does \
                        not; write [1, 1, 1, 1] and colour it by attenuationColor";
            return Err(self.wrong(name, what));
        }
        if material.volume().is_none_or(|volume| volume.thickness_factor() <= 0.0) {
            let what = "without KHR_materials_volume and a thicknessFactor above 0 glass is a \
                        thin wall that bends nothing; write a thicknessFactor";
            return Err(self.wrong(name, what));
        }
        Ok(())
    }

    /// Diffuse, or glowing and black otherwise.
    fn opaque(&self, material: &gltf::Material<'_>, name: &str) -> Result<Surface, ImportError> {
        let [r, g, b, _] = material.pbr_metallic_roughness().base_color_factor().map(f64::from);
        let albedo = DVec3::new(r, g, b);
        if material.extension_value("KHR_materials_unlit").is_some() {
            return Ok(Surface::Unlit { radiance: Paint::Constant(albedo) });
        }
        let radiance = DVec3::from_array(material.emissive_factor().map(f64::from))
            * self.emissive_strength(material, name)?;
        if radiance == DVec3::ZERO {
            return Ok(Surface::Lambert { albedo: Paint::Constant(albedo) });
        }
        if albedo == DVec3::ZERO {
            return Ok(Surface::Unlit { radiance: Paint::Constant(radiance) });
        }
        let what = "a surface that glows and reflects is not rendered; write baseColorFactor \
                    [0, 0, 0, 1] or emissiveFactor [0, 0, 0]";
        Err(self.wrong(name, what))
    }

    /// What `KHR_materials_emissive_strength` multiplies the emission by.
    fn emissive_strength(
        &self,
        material: &gltf::Material<'_>,
        name: &str,
    ) -> Result<f64, ImportError> {
        let Some(value) = material
            .extension_value("KHR_materials_emissive_strength")
            .and_then(|value| value.get("emissiveStrength"))
        else {
            return Ok(1.0);
        };
        value.as_f64().filter(|strength| *strength >= 0.0).ok_or_else(|| {
            self.wrong(name, &format!("emissiveStrength {value} is no number from 0 upwards"))
        })
    }

    fn medium_of(&self, material: &gltf::Material<'_>) -> Result<Medium, ImportError> {
        let name = material.name().unwrap_or("glass").to_owned();
        if material.ior() == Some(0.0) {
            let what = "ior 0 is the extension's word for a surface that reflects everything, as \
                        materials of the specular-glossiness kind may; that is no glass: write \
                        its index, such as 1.5";
            return Err(self.wrong(&name, what));
        }
        let eta = Eta::try_from(f64::from(material.ior().unwrap_or(1.5)))
            .map_err(|error| self.wrong(&name, &error.to_string()))?;
        let mut medium = Medium::plain(&name, eta);
        if let Some(volume) = material.volume() {
            let colour = DVec3::from_array(volume.attenuation_color().map(f64::from));
            let distance_m = f64::from(volume.attenuation_distance());
            if distance_m.is_finite() && distance_m > 0.0 {
                medium.absorption_per_m =
                    DVec3::ZERO - colour.max(DVec3::splat(1e-30)).ln() / distance_m;
            }
        }
        let dispersion = material
            .extension_value("KHR_materials_dispersion")
            .and_then(|value| value.get("dispersion")?.as_f64());
        if let Some(dispersion) = dispersion.filter(|value| *value > 0.0) {
            medium.dispersion = Dispersion::Gltf { dispersion };
        }
        medium
            .check_at(RGB_WAVELENGTH_UM)
            .map_err(|error| self.wrong(&name, &error.to_string()))?;
        Ok(medium)
    }
}
