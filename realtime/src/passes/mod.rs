//! Which pieces of WGSL make up a frame, and what follows from them: the passes,
//! the buffers, and what is left out.

pub(crate) mod backdrop;
pub(crate) mod cracks_and_air;
pub(crate) mod normal_cube;
pub(crate) mod peel;
pub(crate) mod pipelines;
pub(crate) mod raster_pass;
pub(crate) mod raster_state;

use crate::Error;
use crate::composition::chosen::{camera_piece, outputs_piece, piece, reflection};
use crate::composition::inputs::{Order, asked};
use crate::methods::Method;
use crate::passes::backdrop::Backdrop;
use crate::passes::cracks_and_air::Interior;
use crate::passes::raster_pass::{Sides, Surfaces, Target, target};
use crate::wgsl::{Piece, Shader};
use normal_cube as normals;
use peel::Peel;

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
        let keep_all = order.keeps_all();
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
        let background = if drawn {
            piece!("surfaces/background_drawn.wgsl")
        } else {
            piece!("surfaces/background_sky.wgsl")
        };
        let shade = Shader::link(&[
            piece!("core/frame.wgsl"),
            camera_piece(order.camera),
            piece!("core/cube.wgsl"),
            order.environment_piece(drawn),
            piece!("surfaces/front.wgsl"),
            piece!("surfaces/geometric_same.wgsl"),
            background,
            outputs_piece(order.outputs),
            piece!("shade/shade_background.wgsl"),
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

fn shade_pieces(order: &Order<'_>) -> Result<Vec<Piece>, Error> {
    let Order { settings, geometry, .. } = *order;
    let (drawn, keep_all) = (order.draws_backdrop(), order.keeps_all());
    let mut pieces =
        vec![piece!("core/frame.wgsl"), camera_piece(order.camera), piece!("core/interface.wgsl")];
    pieces.extend([piece!("core/cube.wgsl"), order.environment_piece(drawn)]);
    let background = if drawn {
        piece!("surfaces/background_drawn.wgsl")
    } else {
        piece!("surfaces/background_sky.wgsl")
    };
    pieces.extend([
        piece!("surfaces/front.wgsl"),
        piece!("surfaces/back.wgsl"),
        background,
        piece!("shade/shade.wgsl"),
    ]);
    let media = if geometry.nested {
        piece!("layers/media_nested.wgsl")
    } else {
        piece!("layers/media_single.wgsl")
    };
    pieces.push(order.pack());
    pieces.extend(peel::camera_pieces(order));
    pieces.extend([piece!("layers/layers.wgsl"), media, piece!("layers/march.wgsl")]);
    pieces.push(if geometry.bodies.smooth || keep_all {
        piece!("surfaces/geometric_stored.wgsl")
    } else {
        piece!("surfaces/geometric_same.wgsl")
    });
    pieces.extend(if (geometry.disperses || keep_all) && order.method.traces_colours {
        [piece!("shade/eta_dispersed.wgsl"), piece!("shade/colours_apart.wgsl")]
    } else {
        [piece!("shade/eta_single.wgsl"), piece!("shade/colours_together.wgsl")]
    });
    pieces.push(piece!("shade/first_event.wgsl"));
    let absorbs = geometry.absorbs || keep_all;
    pieces.push(if absorbs {
        piece!("shade/absorb.wgsl")
    } else {
        piece!("shade/absorb_none.wgsl")
    });
    pieces.extend(Interior::shown(order));
    pieces.push(outputs_piece(order.outputs));
    if order.is_index_matched() {
        pieces.extend([piece!("shade/reflect_none.wgsl"), piece!("methods/undeviated.wgsl")]);
    } else {
        pieces.extend(reflection(settings));
        pieces.extend(order.method.pieces(settings)?);
    }
    Ok(pieces)
}
