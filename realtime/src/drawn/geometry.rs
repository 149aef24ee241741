//! What one frame shows: the bodies, what is inside them, and what is around.

use crate::drawn::drawables::{Drawables, PlacedShape};
use crate::drawn::extent::Extent;
use crate::drawn::ray_tree::RayTree;
use crate::drawn::uniforms::{Body, Bump, Light, MAX_BODIES, MAX_LIGHTS, Paint};
use crate::error::Error;
use glam::{DVec3, Vec3};
use scenes::medium::RGB_WAVELENGTH_UM;
use scenes::scene::Normals;
use scenes::{Object, Scene, Shape, Surface, box_corners};
use std::sync::OnceLock;

/// Everything that is drawn, at the time of one frame.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    /// Transparent bodies.
    pub(crate) bodies: Drawables,
    /// Their numbers, in the same order.
    pub(crate) media: Vec<Body>,
    /// Bump maps of the bodies, if any has one.
    pub(crate) bumps: Option<Vec<Bump>>,
    /// Opaque surfaces around them.
    pub(crate) opaque: Drawables,
    /// Those of them that the cube about the middle shows: all but solids that the
    /// middle lies in, which would hide everything else.
    pub(crate) opaque_in_cube: Drawables,
    pub(crate) paints: Vec<Paint>,
    pub(crate) lights: Vec<Light>,
    /// Sheets of cracks inside the bodies, not clipped.
    pub(crate) cracks: Drawables,
    /// Planes of air inside the bodies; their normals hold positions on the
    /// plane, -0.5 to 0.5.
    pub(crate) air: Drawables,
    /// Unit vector towards the light that cracks glitter in.
    pub(crate) towards_light_ws: Vec3,
    /// Where the bodies are.
    pub(crate) extent: Extent,
    /// Corners of the bodies' bounds, world space, metres; not finite where a body has
    /// no bounds, and then beyond no side of the view.
    pub(crate) outlines: Vec<[DVec3; 8]>,
    /// Middle of the bodies, local space.
    pub(crate) middle_lc: Vec3,
    /// Some body absorbs.
    pub(crate) absorbs: bool,
    /// Some body's index depends on the colour.
    pub(crate) disperses: bool,
    /// Bodies differ in medium or priority.
    pub(crate) nested: bool,
    /// Something moves or deforms from frame to frame.
    pub(crate) changes: bool,
    /// Some body deforms, so that distances through it change.
    pub(crate) deforms: bool,
    /// Bodies and opaque surfaces of the first frame, if something moves and rays are
    /// followed.
    first: Option<Box<[Drawables; 2]>>,
    /// Of the camera's eye from the local origin, metres.
    eye_distance_m: f64,
    /// What rays meet, made when it is first asked for.
    rays: OnceLock<RayTree>,
}

fn is_solid(object: &Object) -> bool {
    matches!(object.surface, Surface::Dielectric { .. })
}

impl Geometry {
    /// What a frame shows.
    pub(crate) fn new(scene: &Scene, frame: u32) -> Result<Self, Error> {
        Self::about(scene, frame, false)
    }

    /// The same for methods that follow rays: those go everywhere in the bodies, so the
    /// local origin is their middle.
    pub(crate) fn for_rays(scene: &Scene, frame: u32) -> Result<Self, Error> {
        Self::about(scene, frame, true)
    }

    fn about(scene: &Scene, frame: u32, middle_is_origin: bool) -> Result<Self, Error> {
        let time_s = scene.time_s(frame);
        let (solids, opaque): (Vec<&Object>, Vec<&Object>) =
            scene.objects.iter().partition(|object| is_solid(object));
        at_most("bodies", solids.len(), MAX_BODIES)?;
        at_most("opaque objects", opaque.len(), MAX_BODIES)?;
        at_most("lights", scene.lights.len(), MAX_LIGHTS)?;
        scene.media.iter().try_for_each(|medium| medium.check_at(RGB_WAVELENGTH_UM))?;
        let mut extent = Extent::new(scene, &solids, time_s);
        if middle_is_origin {
            extent.origin = extent.middle;
        }
        let centre = extent.origin;
        let moves = |object: &&Object| object.motion.is_some() || object.deform.is_some();
        let mut geometry = Self {
            bodies: Drawables::new(centre),
            media: Vec::new(),
            bumps: None,
            opaque: Drawables::new(centre),
            opaque_in_cube: Drawables::new(centre),
            paints: Vec::new(),
            lights: scene.lights.iter().map(|light| Light::new(light, centre)).collect(),
            cracks: Drawables::new(centre),
            air: Drawables::new(centre),
            towards_light_ws: towards_light(scene),
            extent,
            outlines: Vec::new(),
            middle_lc: middle(&solids, time_s, centre),
            absorbs: false,
            disperses: false,
            nested: false,
            changes: scene.objects.iter().any(|object| moves(&object)),
            deforms: solids.iter().any(|object| object.deform.is_some()),
            eye_distance_m: (scene.camera.eye - centre).length(),
            first: None,
            rays: OnceLock::new(),
        };
        let numbers = numbered(&solids);
        geometry.nested = numbers.iter().any(|solid| *solid > 0);
        for (object, solid) in solids.iter().zip(numbers) {
            geometry.add_body(scene, object, solid, time_s)?;
        }
        for object in opaque {
            geometry.add_opaque(object, time_s);
        }
        Ok(geometry)
    }

    /// Everything that some pass draws.
    pub(crate) fn drawn(&self) -> [&Drawables; 4] {
        [&self.bodies, &self.opaque, &self.cracks, &self.air]
    }

    /// What rays meet.
    pub(crate) fn rays(&self) -> &RayTree {
        let reach_m = self.extent.reach_m.max(self.eye_distance_m);
        let first = self.first.as_ref().map(|first| [&first[0], &first[1]]);
        self.rays.get_or_init(|| RayTree::new([&self.bodies, &self.opaque], first, reach_m))
    }

    /// Lets rays meet the tree of the first frame, refitted, where something moves.
    pub(crate) fn remember_first(&mut self, scene: &Scene) -> Result<(), Error> {
        if self.changes {
            let first = Self::for_rays(scene, 0)?;
            self.first = Some(Box::new([first.bodies, first.opaque]));
        }
        Ok(())
    }

    fn add_body(
        &mut self,
        scene: &Scene,
        object: &Object,
        solid: u32,
        time_s: f64,
    ) -> Result<(), Error> {
        let Some(medium) = scene.medium_of(object) else { return Ok(()) };
        let shape = object.shape_at(time_s);
        scenes::topology::must_be_body(&object.name, shape.mesh()).map_err(Error::NotABody)?;
        self.absorbs |= medium.absorbs();
        self.media.push(Body {
            eta: medium.eta.get() as f32,
            solid,
            absorption_per_m: medium.absorption_per_m.as_vec3(),
            eta_channels: Vec3::from_array(RGB_WAVELENGTH_UM.map(|um| medium.eta_at(um) as f32)),
        });
        self.disperses |= medium.is_dispersive();
        let number = self.media.len() as u32;
        let world_from_object = object.world_from_object_at(time_s);
        let placed =
            PlacedShape { shape: &shape, world_from_object, normals: object.normals, number };
        self.outlines
            .push(box_corners(shape.bounds()).map(|p| world_from_object.transform_point3(p)));
        self.bodies.add(&placed, 1e4 * self.extent.reach_m);
        if let Some(bump) = &object.bump {
            // The bent normal needs the unbent one beside it.
            self.bodies.smooth = true;
            let bumps = self.bumps.get_or_insert_with(|| vec![Bump::default(); MAX_BODIES]);
            bumps[number as usize - 1] = Bump::new(bump, &world_from_object, self.extent.origin);
        }
        self.add_inside(object, &placed);
        Ok(())
    }

    /// Cracks and air.
    fn add_inside(&mut self, object: &Object, body: &PlacedShape<'_>) {
        let bounds = body.shape.bounds();
        let bounded = bounds.iter().all(|corner| corner.is_finite());
        if let Some(crack) = object.crack.as_ref().filter(|_| bounded) {
            for sheet in scenes::crack::cracks(crack, bounds) {
                let shape = Shape::Mesh(sheet);
                self.cracks
                    .add(&PlacedShape { shape: &shape, normals: Normals::Smooth, ..*body }, 0.0);
            }
        }
        if let Some(air) = object.air.as_ref().filter(|_| bounded) {
            for body_from_plane in scenes::air::air_planes(air, bounds) {
                self.air.add_plane(&(body.world_from_object * body_from_plane), body.number);
            }
        }
    }

    /// Cuts the cracks' sheets where they leave their bodies, as the method's
    /// authors propose: nothing is then left to clip while drawing. Bodies
    /// without triangles keep theirs whole.
    pub(crate) fn clip_cracks(&mut self, scene: &Scene, frame: u32) {
        let time_s = scene.time_s(frame);
        self.cracks = Drawables::new(self.extent.origin);
        let solids = scene.objects.iter().filter(|object| is_solid(object));
        for (object, number) in solids.zip(1..) {
            let shape = object.shape_at(time_s);
            let Some(crack) = &object.crack else { continue };
            let world_from_object = object.world_from_object_at(time_s);
            for sheet in scenes::crack::cracks(crack, shape.bounds()) {
                let cut = match scenes::generate::triangulated(&shape) {
                    Some(body) => scenes::crack::clipped(&sheet, &body),
                    None => sheet,
                };
                let sheet = Shape::Mesh(cut);
                let normals = Normals::Smooth;
                self.cracks
                    .add(&PlacedShape { shape: &sheet, world_from_object, normals, number }, 0.0);
            }
        }
    }

    fn add_opaque(&mut self, object: &Object, time_s: f64) {
        let shape = object.shape_at(time_s);
        let world_from_object = object.world_from_object_at(time_s);
        self.paints.push(Paint::new(&object.surface, &world_from_object, self.extent.origin));
        let number = self.paints.len() as u32;
        let placed =
            PlacedShape { shape: &shape, world_from_object, normals: object.normals, number };
        self.opaque.add(&placed, 1e4 * self.extent.reach_m);
        let middle = self.extent.origin + self.middle_lc.as_dvec3();
        let at = world_from_object.inverse().transform_point3(middle);
        let reach_m = self.extent.reach_m / world_from_object.matrix3.col(0).length();
        if !is_small_solid_about(&shape, at, reach_m) {
            self.opaque_in_cube.add(&placed, 1e4 * self.extent.reach_m);
        }
    }
}

fn at_most(what: &'static str, count: usize, most: usize) -> Result<(), Error> {
    if count <= most {
        return Ok(());
    }
    Err(Error::TooMany { what, count, most })
}

/// True if a point (object space) lies in a solid that is too small to be a room
/// around everything within `reach_m`.
fn is_small_solid_about(shape: &Shape, at: DVec3, reach_m: f64) -> bool {
    match shape {
        Shape::Sphere { radius_m } => at.length() < *radius_m && *radius_m < reach_m,
        Shape::Box { half_extent_m } => {
            at.abs().cmplt(*half_extent_m).all() && half_extent_m.min_element() < reach_m
        }
        Shape::Cylinder { radius_m, half_height_m } => {
            let [low, high] = shape.bounds();
            let inside = at.cmpgt(low).all() && at.cmplt(high).all();
            inside && radius_m.min(*half_height_m) < reach_m
        }
        Shape::Mesh(_) | Shape::Slab { .. } | Shape::HalfSpace => false,
    }
}

/// Middle of the bodies' bounds; the centre if none is bounded.
fn middle(solids: &[&Object], time_s: f64, centre: DVec3) -> Vec3 {
    let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    for object in solids {
        let [low, high] = object.shape.bounds();
        let at = object.world_from_object_at(time_s).transform_point3(0.5 * (low + high));
        if at.is_finite() {
            bounds = [bounds[0].min(at), bounds[1].max(at)];
        }
    }
    let middle = 0.5 * (bounds[0] + bounds[1]);
    if middle.is_finite() { (middle - centre).as_vec3() } else { Vec3::ZERO }
}

/// The scene's first light, or else a light from above.
fn towards_light(scene: &Scene) -> Vec3 {
    use scenes::scene::Light;
    let towards = match scene.lights.first() {
        Some(Light::Directional { direction, .. }) => -*direction,
        Some(Light::Point { position_m, .. }) => *position_m - scene.camera.target,
        None => DVec3::new(0.4, 0.8, 0.45),
    };
    towards.normalize_or(DVec3::Y).as_vec3()
}

/// Numbers by falling priority, then medium; bodies of one medium and priority
/// are one solid.
fn numbered(solids: &[&Object]) -> Vec<u32> {
    let key = |object: &&Object| match object.surface {
        Surface::Dielectric { medium, priority } => (-i64::from(priority), medium),
        _ => (i64::MAX, scenes::MediumId::SURROUNDINGS),
    };
    let mut kinds: Vec<_> = solids.iter().map(key).collect();
    kinds.sort();
    kinds.dedup();
    let number = |object| kinds.iter().position(|kind| *kind == key(object)).unwrap_or(0);
    solids.iter().map(|object| number(object) as u32).collect()
}
