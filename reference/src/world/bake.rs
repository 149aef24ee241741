//! Bakes a frame of a scene into a world.

use super::{Body, Class, Role, World};
use crate::error::Error;
use crate::geometry::analytic_body::AnalyticBody;
use crate::geometry::bvh::{MOST_TRIANGLES, Tree};
use crate::geometry::shading_normals::shading_normals;
use crate::geometry::soup::Soup;
use crate::request::Level;
use glam::{DAffine3, DVec3};
use scenes::air::bubbles;
use scenes::crack::cracks;
use scenes::scene::Normals;
use scenes::topology::must_be_body;
use scenes::{MediumId, Object, Scene, Shape, Surface, box_corners};
use std::sync::Arc;

impl World {
    /// Bakes a frame of the scene.
    ///
    /// # Errors
    /// A dielectric mesh has no inside, or there are too many triangles or media.
    pub(crate) fn new(scene: &Scene, frame: u32, level: Level) -> Result<Self, Error> {
        let shown = |object: &Object| {
            level == Level::R2 || matches!(object.surface, Surface::Dielectric { .. })
        };
        let objects: Vec<(usize, &Object)> =
            scene.objects.iter().enumerate().filter(|(_, object)| shown(object)).collect();
        // Air that no medium of the scene stands for.
        let air = MediumId(u16::try_from(scene.media.len()).unwrap_or(u16::MAX));
        let classes = classes_of(&objects, air);
        if classes.len() > 256 {
            return Err(Error::TooManyMedia(classes.len()));
        }
        let count: usize =
            objects.iter().filter_map(|(_, o)| o.shape.mesh()).map(|m| m.triangles.len()).sum();
        if count > MOST_TRIANGLES {
            return Err(too_many(count));
        }
        let mut world = Self {
            tree: Tree::default(),
            bodies: Vec::with_capacity(objects.len()),
            analytic: Vec::new(),
            first_analytic: 0,
            classes,
            bounds: [DVec3::INFINITY, DVec3::NEG_INFINITY],
        };
        let mut triangles = Soup::default();
        let time_s = scene.time_s(frame);
        for (index, object) in objects {
            world.add(index, object, time_s, air, &mut triangles)?;
        }
        if triangles.len() > MOST_TRIANGLES {
            return Err(too_many(triangles.len()));
        }
        world.first_analytic = triangles.len() as u32;
        for (index, analytic) in world.analytic.iter_mut().enumerate() {
            analytic.id = world.first_analytic + 2 * index as u32;
        }
        world.tree = Tree::build(&triangles);
        Ok(world)
    }

    /// Widens the bounds by a box in object space.
    fn include(&mut self, bounds: [DVec3; 2], world_from_object: DAffine3) {
        let [mut least, mut most] = self.bounds;
        for corner in box_corners(bounds) {
            if !corner.is_finite() {
                self.bounds = [DVec3::NEG_INFINITY, DVec3::INFINITY];
                return;
            }
            let point = world_from_object.transform_point3(corner);
            (least, most) = (least.min(point), most.max(point));
        }
        // Room for what rounding does to the corners.
        let room = (most - least).max_element() * 1e-9;
        self.bounds = [least - room, most + room];
    }

    /// Adds an object with what is inside it.
    fn add(
        &mut self,
        index: usize,
        object: &Object,
        time_s: f64,
        air: MediumId,
        triangles: &mut Soup,
    ) -> Result<(), Error> {
        let place = object.world_from_object_at(time_s);
        let shape = object.shape_at(time_s);
        self.include(shape.bounds(), place);
        let Surface::Dielectric { medium, priority } = object.surface else {
            let opaque = body(index, Role::Opaque, place);
            self.add_shape(opaque, &shape, object.normals, triangles);
            return Ok(());
        };
        must_be_body(&object.name, shape.mesh())?;
        let host = self.class(Class { medium, priority });
        let solid = Body { bump: object.bump, ..body(index, Role::Solid(host), place) };
        self.add_shape(solid, &shape, object.normals, triangles);
        for bubble in object.air.iter().flat_map(|air| bubbles(air, &shape)) {
            let role = Role::Solid(self.class(air_in(priority, air)));
            let place = place * DAffine3::from_translation(bubble.centre_m);
            let ball = Arc::new(Shape::Sphere { radius_m: bubble.radius_m });
            self.add_shape(body(index, role, place), &ball, Normals::Flat, triangles);
        }
        let bounds = shape.bounds();
        let crack = object.crack.filter(|_| bounds[0].is_finite() && bounds[1].is_finite());
        for surface in crack.iter().flat_map(|crack| cracks(crack, bounds)) {
            let surface = Arc::new(Shape::Mesh(surface));
            let crack = body(index, Role::Crack(host), place);
            self.add_shape(crack, &surface, Normals::Smooth, triangles);
        }
        Ok(())
    }

    fn add_shape(
        &mut self,
        mut body: Body,
        shape: &Arc<Shape>,
        normals: Normals,
        triangles: &mut Soup,
    ) {
        let number = self.bodies.len() as u32;
        body.first_id = triangles.len() as u32;
        if shape.mesh().is_some() {
            triangles.add(shape, body.world_from_object, number);
            if normals == Normals::Smooth {
                let normal_from_object = body.object_from_world.matrix3.transpose();
                body.smooth = shading_normals(shape, normal_from_object);
            }
        } else {
            self.analytic.push(AnalyticBody::new(number, shape, body.world_from_object));
        }
        self.bodies.push(body);
    }

    /// Index of a class; every class was collected before.
    fn class(&self, wanted: Class) -> usize {
        self.classes.iter().position(|class| *class == wanted).unwrap_or(0)
    }
}

fn body(object: usize, role: Role, world_from_object: DAffine3) -> Body {
    let object_from_world = world_from_object.inverse();
    let (smooth, bump) = (None, None);
    Body { object, role, world_from_object, object_from_world, first_id: 0, smooth, bump }
}

/// Air in a solid of some priority.
fn air_in(priority: i32, air: MediumId) -> Class {
    Class { medium: air, priority: priority.saturating_add(1) }
}

fn too_many(count: usize) -> Error {
    Error::TooManyTriangles { count, most: MOST_TRIANGLES }
}

fn classes_of(objects: &[(usize, &Object)], air: MediumId) -> Vec<Class> {
    let mut classes = Vec::new();
    for (_, object) in objects {
        if let Surface::Dielectric { medium, priority } = object.surface {
            classes.push(Class { medium, priority });
            if object.air.is_some_and(|air| air.bubbles > 0) {
                classes.push(air_in(priority, air));
            }
        }
    }
    classes.sort_by_key(|class| (std::cmp::Reverse(class.priority), class.medium));
    classes.dedup();
    classes
}
