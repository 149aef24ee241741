//! Crossings of a line with any body, and what the surface is like there.

use crate::geometry::bvh::{Query, Stack, TriangleHit};
use crate::geometry::line::{Line, ROUNDING};
use crate::optics::bend::SurfaceNormals;
use crate::world::{Body, World};
use glam::DVec3;
use scenes::noise::bumped;
use scenes::scene::Bump;

/// A line's passage through a body's surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    pub(crate) t: f64,
    /// Number of the triangle, or of the analytic body's entry or exit.
    pub(crate) id: u32,
    pub(crate) body: u32,
    pub(crate) entering: bool,
    surface: OnSurface,
}

#[derive(Clone, Copy, Debug)]
enum OnSurface {
    Triangle { slot: u32, weights: [f64; 3] },
    Analytic { point: DVec3, normal: DVec3 },
}

/// A surface where a ray meets it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    pub(crate) position: DVec3,
    pub(crate) normals: SurfaceNormals,
    /// Distance to the nearest edge of the triangle; infinite where there is none.
    pub(crate) margin: f64,
}

/// The surface a ray has just left, which it cannot meet at once again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Departed {
    pub(crate) id: u32,
    /// The ray goes on inside the body.
    pub(crate) inside: bool,
}

/// The closest crossing and the t of the next one, if within rounding of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Next {
    pub(crate) first: Option<Crossing>,
    pub(crate) second_t: f64,
    /// The chord of the departed body is too short to be seen.
    pub(crate) lost: bool,
}

impl Crossing {
    fn of_triangle(hit: TriangleHit) -> Self {
        let (pierce, slot) = (hit.pierce, hit.slot);
        let surface = OnSurface::Triangle { slot, weights: pierce.weights };
        Self { t: pierce.t, id: hit.id, body: hit.body, entering: pierce.entering, surface }
    }

    /// Order along the line; ties go to the smaller number.
    pub(crate) fn key(&self) -> (f64, u32) {
        (self.t, self.id)
    }
}

impl World {
    /// The first crossing after (t, id) that is not with the departed surface.
    pub(crate) fn next(
        &self,
        line: &Line,
        departed: Option<Departed>,
        after: (f64, u32),
        stack: &mut Stack,
    ) -> Next {
        let skip = departed.map_or(u32::MAX, |departed| departed.id);
        let found = self.tree.closest(line, Query { skip, after }, stack);
        let first = found.first.map(Crossing::of_triangle);
        let mut next = Next { first, second_t: found.second_t, lost: false };
        for analytic in &self.analytic {
            let own = departed.filter(|d| self.same_analytic(d.id, analytic.id));
            if own.is_some_and(|own| !own.inside) {
                continue;
            }
            if own.is_none() && analytic.is_passed_by(line) {
                continue;
            }
            let Some(chord) = analytic.chord(line) else {
                next.lost |= own.is_some();
                continue;
            };
            for (side, (t, point, normal)) in chord.into_iter().enumerate() {
                if own.is_some() && side == 0 {
                    continue;
                }
                let crossing = Crossing {
                    t: if own.is_some() { t.max(0.0) } else { t },
                    id: analytic.id + side as u32,
                    body: analytic.body,
                    entering: side == 0,
                    surface: OnSurface::Analytic { point, normal },
                };
                // Its own far side too is passed only once.
                if crossing.t.is_finite() && crossing.key() > after {
                    next.consider(crossing);
                }
            }
        }
        next
    }

    /// Every crossing of the full line, in order.
    pub(crate) fn all_crossings(&self, line: &Line, into: &mut Vec<Crossing>) {
        into.clear();
        self.tree.crossings(line, |hit| into.push(Crossing::of_triangle(hit)));
        for analytic in self.analytic.iter().filter(|analytic| !analytic.is_passed_by(line)) {
            for (side, touch) in analytic.chord(line).into_iter().flatten().enumerate() {
                let (t, point, normal) = touch;
                let surface = OnSurface::Analytic { point, normal };
                let (id, body) = (analytic.id + side as u32, analytic.body);
                into.push(Crossing { t, id, body, entering: side == 0, surface });
            }
        }
        into.sort_unstable_by(|a, b| a.t.total_cmp(&b.t).then(a.id.cmp(&b.id)));
    }

    /// Cosine between a line and the surface's normal at a crossing, ≥ 0.
    pub(crate) fn cosine(&self, line: &Line, crossing: &Crossing) -> f64 {
        let normal = match crossing.surface {
            OnSurface::Triangle { slot, .. } => self.tree.triangle(slot).normal(),
            OnSurface::Analytic { normal, .. } => normal,
        };
        line.direction.dot(normal).abs()
    }

    /// What the surface is like at a crossing.
    pub(crate) fn spot(&self, crossing: &Crossing) -> Spot {
        let body = &self.bodies[crossing.body as usize];
        let (position, geometric, margin, mut shading) = match crossing.surface {
            OnSurface::Analytic { point, normal } => (point, normal, f64::INFINITY, normal),
            OnSurface::Triangle { slot, weights } => {
                let triangle = self.tree.triangle(slot);
                let (geometric, margin) = triangle.normal_and_margin(weights);
                let shading = body.smooth.as_ref().map_or(geometric, |smooth| {
                    let n = smooth.at((crossing.id - body.first_id) as usize, weights);
                    if n == DVec3::ZERO { geometric } else { n }
                });
                (triangle.point(weights), geometric, margin, shading)
            }
        };
        if let Some(bump) = &body.bump {
            shading = body.tilted(bump, position, shading);
        }
        Spot { position, normals: SurfaceNormals { geometric, shading }, margin }
    }
}

impl Body {
    /// A normal under a bump map; both in world space.
    fn tilted(&self, bump: &Bump, position: DVec3, normal: DVec3) -> DVec3 {
        let here = self.object_from_world.transform_point3(position);
        let [to_world, to_object] =
            [self.object_from_world, self.world_from_object].map(|m| m.matrix3.transpose());
        let tilted = bumped((to_object * normal).normalize_or_zero(), here, bump);
        let world = (to_world * tilted).normalize_or_zero();
        if world.is_finite() && world != DVec3::ZERO { world } else { normal }
    }
}

impl Next {
    fn consider(&mut self, crossing: Crossing) {
        match &self.first {
            Some(first) if first.key() < crossing.key() => {
                self.second_t = self.second_t.min(crossing.t);
            }
            first => {
                self.second_t = first.map_or(f64::INFINITY, |first| first.t);
                self.first = Some(crossing);
            }
        }
    }
}

impl Spot {
    /// True when a ray that leaves this spot in a direction certainly crosses
    /// its surface here, whatever rounding did to the position.
    pub(crate) fn is_clear(&self, direction: DVec3) -> bool {
        let blur = ROUNDING * self.position.abs().max_element();
        self.margin * direction.dot(self.normals.geometric).abs() > blur
    }
}
