//! Which pieces of WGSL make up a frame, and what follows from them: the passes,
//! the buffers, and what is left out.

use crate::backdrop::Backdrop;
use crate::geometry::Geometry;
use crate::in_image::{in_view, projected_px};
use crate::interior::Interior;
use crate::method::{Method, Settings};
use crate::normals;
use crate::peel::{self, Peel};
use crate::pieces::{
    camera_piece, outputs_piece, piece, reflection, stored_normal_piece, vector_piece,
};
use crate::surfaces::{Sides, Surfaces, Target, target};
use crate::uniforms::Body;
use crate::wgsl::{Piece, Shader};
use crate::{Error, Request};
use glam::DVec2;
use scenes::{Camera, Environment, LayerName, Scene};

/// Everything the front pass can write.
const FRONT: [Target; 5] = [
    target("front_normal", true, "vec4f(surface_normal_ws(v), v.body)"),
    target("front_depth", false, "depth_of_m(v.p_lc)"),
    target("front_geometric", true, "vec4f(v.geometric_ws, 1.0)"),
    target("front_vector", true, "v.vector_ws"),
    target("front_thickness", false, "v.thickness_m"),
];

/// Everything the back pass can write.
const BACK: [Target; 2] = [
    target("back_normal", true, "vec4f(stored_normal(surface_normal_ws(v)), v.body)"),
    target("back_depth", false, "depth_of_m(v.p_lc)"),
];

/// A frame, as far as it can be known without a GPU.
pub(crate) struct Composition {
    pub(crate) method: &'static Method,
    /// Nothing bends light here.
    pub(crate) index_matched: bool,
    pub(crate) shade: Shader,
    pub(crate) outputs: Vec<&'static str>,
    pub(crate) backdrop: Option<Backdrop>,
    pub(crate) front: Option<Surfaces>,
    pub(crate) back: Option<Surfaces>,
    pub(crate) peel: Option<Peel>,
    pub(crate) interior: Option<Interior>,
    /// Normals of the bodies in a cube about their middle.
    pub(crate) normals: Option<Surfaces>,
    /// Column, row, width and height of the pixels that the bodies can reach, if
    /// they are not all.
    pub(crate) within_px: Option<[u32; 4]>,
}

/// How the environment is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// By hand, with the exact renderer's formula: judged images.
    Manual,
    /// By the hardware's sampler: timed frames.
    Hardware,
}

/// What is to be composed.
#[derive(Clone, Copy)]
pub(crate) struct Order<'a> {
    pub(crate) method: &'static Method,
    pub(crate) settings: &'a Settings,
    pub(crate) scene: &'a Scene,
    pub(crate) camera: &'a Camera,
    pub(crate) geometry: &'a Geometry,
    pub(crate) request: &'a Request,
    /// Images that shading writes.
    pub(crate) outputs: &'a [&'static str],
    /// Of the surface buffers.
    pub(crate) resolution_px: [u32; 2],
}

impl Composition {
    pub(crate) fn new(order: &Order<'_>) -> Result<Self, Error> {
        let Order { settings, geometry, .. } = *order;
        if order.is_off_screen() {
            return Self::of_background(order);
        }
        let shade = Shader::link(&shade_pieces(order)?)?;
        let head = order.raster_head();
        let interior = Interior::new(order, &head)?;
        let wanted = |target: &Target| {
            let inside = interior.as_ref().is_some_and(|interior| interior.reads(target.name));
            shade.uses(&["shade"], target.name) || inside || asked(order.request, target.name)
        };
        let keep_all = !order.request.elide;
        let wanted = |target: &Target| keep_all || wanted(target);
        let front: Vec<Target> = FRONT.into_iter().filter(wanted).collect();
        let back: Vec<Target> = BACK.into_iter().filter(wanted).collect();
        let surfaces =
            |name, targets, sides| Surfaces::new(name, targets, sides, &head, &geometry.bodies);
        let farthest = settings.word_if_any("back_select") != Some("nearest");
        let back = (!back.is_empty()).then(|| surfaces("back", back, Sides::Back { farthest }));
        let normals = shade
            .uses(&["shade"], "normal_faces")
            .then(|| normals::composed(order, &geometry.bodies));
        let peels = shade.uses(&["shade"], "slot_counts")
            || peel::asked_for(order.request)
            || interior.as_ref().is_some_and(|interior| interior.reads("slot_counts"));
        Ok(Self {
            method: order.method,
            index_matched: order.is_index_matched(),
            backdrop: Backdrop::new(order)?,
            front: Some(surfaces("front", front, Sides::Front)?),
            back: back.transpose()?,
            peel: if peels { Some(Peel::new(order, &head)?) } else { None },
            normals: normals.transpose()?,
            within_px: order.within_px(),
            interior,
            shade,
            outputs: order.outputs.to_vec(),
        })
    }

    /// No body is in the image: what is around them is all there is.
    fn of_background(order: &Order<'_>) -> Result<Self, Error> {
        let drawn = order.draws_backdrop();
        let background =
            if drawn { piece!("background_drawn.wgsl") } else { piece!("background_sky.wgsl") };
        let shade = Shader::link(&[
            piece!("frame.wgsl"),
            camera_piece(order.camera),
            piece!("cube.wgsl"),
            order.environment_piece(drawn),
            piece!("front.wgsl"),
            piece!("geometric_same.wgsl"),
            background,
            outputs_piece(order.outputs),
            piece!("shade_background.wgsl"),
        ])?;
        Ok(Self {
            method: order.method,
            index_matched: order.is_index_matched(),
            backdrop: Backdrop::new(order)?,
            front: None,
            back: None,
            peel: None,
            interior: None,
            normals: None,
            within_px: None,
            shade,
            outputs: order.outputs.to_vec(),
        })
    }

    /// True if some pass reads the distance through the body.
    pub(crate) fn reads_thickness(&self) -> bool {
        let front = self.front.iter().flat_map(|front| &front.targets);
        front.into_iter().any(|target| target.name == "front_thickness")
    }

    /// True if cracks are drawn that end at the body's surface by themselves.
    pub(crate) fn draws_clipped_cracks(&self) -> bool {
        self.interior.as_ref().is_some_and(|interior| interior.clipped_sheets)
    }
}

impl Order<'_> {
    /// How an interface becomes 32 bits.
    pub(crate) fn pack(&self) -> Piece {
        if self.geometry.nested { piece!("pack_nested.wgsl") } else { piece!("pack_single.wgsl") }
    }

    /// What every pass that draws the bodies begins with.
    fn raster_head(&self) -> Vec<Piece> {
        self.raster_head_of(camera_piece(self.camera))
    }

    /// The same for another camera.
    pub(crate) fn raster_head_of(&self, camera: Piece) -> Vec<Piece> {
        let mut head = vec![piece!("frame.wgsl"), camera];
        head.extend(vector_piece(self.method, self.settings));
        match self.geometry.bumps {
            Some(_) => head.extend([piece!("noise.wgsl"), piece!("bump.wgsl")]),
            None => head.push(piece!("bump_none.wgsl")),
        }
        head.push(stored_normal_piece(self.settings));
        head
    }

    /// No body's bounds reach into the image, and nobody asks for its buffers.
    pub(crate) fn is_off_screen(&self) -> bool {
        let asks = self.request.view.layers.iter().any(|l| matches!(l, LayerName::Buffer(_)));
        let shown = || self.geometry.outlines.iter().any(|corners| in_view(self.camera, corners));
        self.request.elide && !asks && !shown()
    }

    /// The rectangle of pixels around the bodies' bounds, with a pixel to spare.
    /// None if it is the whole image, or a corner lies behind the eye.
    fn within_px(&self) -> Option<[u32; 4]> {
        if !self.request.elide {
            return None;
        }
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for corner in self.geometry.outlines.iter().flatten() {
            let at = projected_px(self.camera, *corner, self.resolution_px)?;
            (low, high) = (low.min(at), high.max(at));
        }
        let size = DVec2::from_array(self.resolution_px.map(f64::from));
        let low = (low.floor() - 1.0).clamp(DVec2::ZERO, size);
        let high = (high.ceil() + 1.0).clamp(DVec2::ZERO, size);
        let extent = high - low;
        let partial = extent.min_element() >= 1.0 && extent != size;
        partial.then(|| [low.x, low.y, extent.x, extent.y].map(|v| v as u32))
    }

    /// The bodies have the index of what is around them and take no light. What
    /// is interpolated between vertices bends a little even so, and eq. 4 of
    /// Seipel & Nivfors reflects whatever the index: they are left as they are.
    pub(crate) fn is_index_matched(&self) -> bool {
        let outside = self.scene.media[0].eta.get();
        let same = |body: &Body| (f64::from(body.eta) / outside - 1.0).abs() < 1e-7;
        let geometry = self.geometry;
        let bends_anyway = self.method.id.ends_with("-vertex")
            || self.settings.word_if_any("fresnel") == Some("eq4");
        self.request.elide
            && !bends_anyway
            && geometry.media.iter().all(same)
            && !geometry.absorbs
            && !geometry.disperses
    }

    /// Opaque surfaces stand around the bodies.
    pub(crate) fn draws_backdrop(&self) -> bool {
        !self.geometry.opaque.is_empty()
    }

    /// How the environment is looked up: the scene's, or one that was drawn.
    pub(crate) fn environment_piece(&self, drawn: bool) -> Piece {
        match (&self.scene.environment, self.request.filter) {
            (Environment::Uniform(_), _) if !drawn => piece!("environment_uniform.wgsl"),
            (_, Filter::Manual) => piece!("environment_manual.wgsl"),
            (_, Filter::Hardware) => piece!("environment_sampler.wgsl"),
        }
    }
}

fn shade_pieces(order: &Order<'_>) -> Result<Vec<Piece>, Error> {
    let Order { settings, geometry, .. } = *order;
    let (drawn, keep_all) = (order.draws_backdrop(), !order.request.elide);
    let mut pieces =
        vec![piece!("frame.wgsl"), camera_piece(order.camera), piece!("interface.wgsl")];
    pieces.extend([piece!("cube.wgsl"), order.environment_piece(drawn)]);
    let background =
        if drawn { piece!("background_drawn.wgsl") } else { piece!("background_sky.wgsl") };
    pieces.extend([piece!("front.wgsl"), piece!("back.wgsl"), background, piece!("shade.wgsl")]);
    let media =
        if geometry.nested { piece!("media_nested.wgsl") } else { piece!("media_single.wgsl") };
    pieces.push(order.pack());
    pieces.extend(peel::camera_pieces(order));
    pieces.extend([piece!("layers.wgsl"), media, piece!("march.wgsl")]);
    pieces.push(if geometry.bodies.smooth || keep_all {
        piece!("geometric_stored.wgsl")
    } else {
        piece!("geometric_same.wgsl")
    });
    pieces.extend(if (geometry.disperses || keep_all) && order.method.traces_colours {
        [piece!("eta_dispersed.wgsl"), piece!("colours_apart.wgsl")]
    } else {
        [piece!("eta_single.wgsl"), piece!("colours_together.wgsl")]
    });
    pieces.push(piece!("first_event.wgsl"));
    let absorbs = geometry.absorbs || keep_all;
    pieces.push(if absorbs { piece!("absorb.wgsl") } else { piece!("absorb_none.wgsl") });
    pieces.extend(Interior::shown(order));
    pieces.push(outputs_piece(order.outputs));
    if order.is_index_matched() {
        pieces.extend([piece!("reflect_none.wgsl"), piece!("undeviated.wgsl")]);
    } else {
        pieces.extend(reflection(settings));
        pieces.extend(order.method.pieces(settings)?);
    }
    Ok(pieces)
}

pub(crate) fn asked(request: &Request, name: &str) -> bool {
    request.view.layers.iter().any(|layer| match layer {
        LayerName::Buffer(buffer) if buffer == "thickness" => name.ends_with("_depth"),
        LayerName::Buffer(buffer) => buffer == name,
        _ => false,
    })
}
