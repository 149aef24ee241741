//! What every way of tracing shares: the scene, its light, and where rays start.

use crate::receiver::map::CausticMap;
use crate::request::{Disturbance, EnvironmentLookup, Request, Restriction};
use crate::transport::media_optics::MediaOptics;
use crate::transport::spectrum::{D_LINE_UM, Wavelength};
use crate::world::flight::{Flight, Start};
use crate::world::scratch::Scratch;
use crate::world::winding::{Counts, Winding};
use crate::world::{Body, World};
use glam::DVec3;
use scenes::{Camera, Environment, Projection, Ray, Scene};

/// A scene, ready to be traced for a request.
#[derive(Debug)]
pub(crate) struct Tracer<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) world: &'a World,
    /// At the wavelength of indices: what chains follow.
    pub(crate) d_line: MediaOptics,
    /// What light is made of; one where nothing disperses.
    pub(crate) wavelengths: Vec<Wavelength>,
    pub(crate) restriction: Restriction,
    /// Of every event of a chain.
    pub(crate) disturbance: Disturbance,
    pub(crate) lookup: EnvironmentLookup,
    /// Winding counts at the eye, if all rays start there.
    pub(crate) eye_counts: Option<Vec<i16>>,
    /// A body has shading normals, which may trap light.
    pub(crate) may_trap: bool,
    /// Light on one of the opaque faces.
    pub(crate) caustics: Option<&'a CausticMap>,
}

impl Tracer<'_> {
    /// Radiance from infinity along a unit direction. With `UNIFORM` nothing is
    /// looked up.
    #[inline(always)]
    pub(crate) fn environment<const UNIFORM: bool>(&self, direction: DVec3) -> DVec3 {
        match (&self.scene.environment, self.lookup) {
            (Environment::Uniform(radiance), _) => *radiance,
            _ if UNIFORM => DVec3::ZERO,
            (map, EnvironmentLookup::Cube) => map.radiance(direction),
            (map, EnvironmentLookup::LatLong) => map.radiance_lat_long(direction),
        }
    }

    /// A ray from the camera, which may stand inside a body.
    pub(crate) fn launch<W: Winding>(&self, ray: Ray, scratch: &mut Scratch) -> Flight<W> {
        let [low, high] = self.world.bounds;
        let mut winding = W::outside();
        if ray.origin.cmpge(low).all() && ray.origin.cmple(high).all() {
            match &self.eye_counts {
                None => winding = self.world.winding_at(ray.origin, scratch),
                Some(counts) => {
                    for (class, count) in counts.iter().enumerate() {
                        winding.set(class, *count);
                    }
                }
            }
        }
        Flight { origin: ray.origin, direction: ray.direction, start: Start::Free, winding }
    }
}

impl<'a> Tracer<'a> {
    /// Prepares to trace a baked scene from a camera.
    pub(crate) fn new(
        scene: &'a Scene,
        world: &'a World,
        camera: &Camera,
        request: &'a Request,
    ) -> Self {
        let restriction = request.restriction;
        let d_line = MediaOptics::new(scene, world, D_LINE_UM, restriction.fresnel);
        let wavelengths = Wavelength::all(scene, world, request.spectrum, &restriction);
        let eye_counts = matches!(camera.projection, Projection::Perspective { .. }).then(|| {
            let winding: Counts<256> = world.winding_at(camera.eye, &mut Scratch::default());
            (0..world.classes.len()).map(|class| winding.get(class)).collect()
        });
        let lookup = request.environment_lookup;
        let caustics = request.caustics.as_deref();
        let may_trap = world.bodies.iter().any(Body::has_shading_normals);
        Self {
            scene,
            world,
            d_line,
            wavelengths,
            restriction,
            disturbance: request.disturbance,
            lookup,
            eye_counts,
            may_trap,
            caustics,
        }
    }
}
