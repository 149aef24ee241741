//! Which pieces of WGSL make up a frame, and what follows from them: the passes,
//! the buffers, and what is left out.

use crate::Error;
use crate::backdrop::Backdrop;
use crate::interior::Interior;
use crate::method::Method;
use crate::normals;
use crate::order::{Order, asked};
use crate::peel::{self, Peel};
use crate::pieces::{camera_piece, outputs_piece, piece, reflection};
use crate::surfaces::{Sides, Surfaces, Target, target};
use crate::wgsl::{Piece, Shader};

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
