//! A blade: petal, leaf or sepal as a template on a rest surface, with the form that bends it.
//!
//! The template's outline lies in the blade's own plane: v along the axis from base to tip, u to the right of it, in metres.
//! The rest surface says where that plane stands in the world; the form (000 eqs. 5.1 to 5.3) is what the plant, not the
//! drawing, adds: bending, cupping, thickness. The model stage turns all three into a mesh.

use super::{BezierPatch, Cone, RingSheet, Template, TemplateId};
use glam::{Quat, Vec2, Vec3};
use serde::Serialize;
use std::ops::Deref;
use std::sync::Arc;

crate::parameters! {
    /// How a blade departs from its rest surface; lengths are shares of the blade's length.
    #[derive(Copy)]
    pub struct BladeForm {
        /// Quartic term of bending away from the face, 000 eq. 5.1 `A`.
        bend_quartic: f32 = 0.04, -1.0..=1.0, "";
        /// Quadratic term of bending away from the face, 000 eq. 5.1 `B`.
        bend_quadratic: f32 = 0.08, -1.0..=1.0, "";
        /// Depth of the hollow, 000 eqs. 5.2 and 5.3 `A·B`; negative bulges.
        cup: f32 = 0.3, -2.0..=2.0, "";
        /// Height of the fold along the midrib: both halves rise from it like a V.
        fold: f32 = 0.0, -1.0..=1.0, "";
        /// Amplitude of waves along the margin.
        ruffle: f32 = 0.0, 0.0..=0.3, "of the length";
        /// Waves along the whole margin.
        ruffle_waves: f32 = 0.0, 0.0..=40.0, "";
        /// Thickness in the middle.
        thickness: f32 = 0.01, 0.001..=0.1, "of the length";
        /// Slope across the blade, the right margin toward whom it is drawn for: petals of one flower that all have it lie over
        /// their neighbours on one side and under them on the other, as in contorted flowers. Steeper near the foot.
        twist: f32 = 0.0, -1.0..=1.0, "";
    }
}

impl BladeForm {
    /// Its numbers in the order in which they are declared.
    pub fn to_row(&self) -> [f32; 8] {
        let Self { bend_quartic, bend_quadratic, cup, fold, ruffle, ruffle_waves, thickness, twist } = *self;
        [bend_quartic, bend_quadratic, cup, fold, ruffle, ruffle_waves, thickness, twist]
    }

    /// The form with these numbers.
    pub fn from_row(row: [f32; 8]) -> Self {
        let [bend_quartic, bend_quadratic, cup, fold, ruffle, ruffle_waves, thickness, twist] = row;
        Self { bend_quartic, bend_quadratic, cup, fold, ruffle, ruffle_waves, thickness, twist }
    }
}

/// Where the blade's plane stands in the world before it bends.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RestSurface {
    /// The plane through `base` spanned by `u` and `v`.
    Plane,
    /// The side of a cone as it is seen against `sight`: across that as the plane lies, which is square to it, along it as
    /// deep as the cone's sheet near `hint`.
    Cone {
        /// The cone, in world metres.
        cone: Cone,
        /// Depth of the blade's tip along `sight`, metres: tells which of the cone's two depths is meant.
        hint: f32,
        /// Unit direction toward whom the blade was drawn for; +z unless its flower was turned.
        sight: Vec3,
    },
    /// The side of a cone, as drawn, with every place of it moved on.
    Shaped {
        /// The cone, in world metres.
        cone: Cone,
        /// Depth of the blade's tip on it, along `sight`.
        hint: f32,
        /// Unit direction toward whom the blade was drawn for.
        sight: Vec3,
        /// How far, as a Bézier patch whose control points are ways: along u, along v and toward the face.
        ways: Arc<BezierPatch>,
    },
    /// A curved sheet in the frame of the blade: u, v, and toward the face. Copies of one petal share it.
    Patch(Arc<BezierPatch>),
    /// A sheet on a ring of a full flower, in the same frame. Petals that differ in nothing but their place share it.
    Ring(Arc<RingSheet>),
}

/// A petal, leaf or sepal: a copy of a template with its own pose and form.
///
/// In a plant it names its template by its place. Who needs the template too takes a [`ResolvedBlade`]; makers may hand
/// blades on with templates that no plant has yet.
#[derive(Clone, Debug, PartialEq)]
pub struct Blade<T = TemplateId> {
    /// Its outline, curl and length.
    pub template: T,
    /// World position of the base, (u, v) = 0.
    pub base: Vec3,
    /// World vector of u, unit length unless the blade is an affine copy.
    pub u: Vec3,
    /// World vector of v, unit length unless the blade is an affine copy.
    pub v: Vec3,
    /// Where the plane stands.
    pub rest: RestSurface,
    /// How the blade departs from it.
    pub form: BladeForm,
}

/// A blade together with its template.
pub type ResolvedBlade<'a> = Blade<&'a Template>;

impl<T> Blade<T> {
    /// The same copy of another template.
    pub fn with_template<U>(&self, template: U) -> Blade<U> {
        let Self { template: _, base, u, v, ref rest, form } = *self;
        Blade { template, base, u, v, rest: rest.clone(), form }
    }

    /// Moves it with its rest surface.
    pub fn translate(&mut self, by: Vec3) {
        self.base += by;
        if let RestSurface::Cone { cone, hint, sight } | RestSurface::Shaped { cone, hint, sight, .. } =
            &mut self.rest
        {
            cone.apex += by;
            *hint += by.dot(*sight);
        }
    }
}

impl<T: Deref<Target = Template>> Blade<T> {
    /// The blade with its template, by reference.
    pub fn resolved(&self) -> ResolvedBlade<'_> {
        self.with_template(&*self.template)
    }

    /// World position of plane coordinates on the rest surface.
    pub fn at_rest(&self, uv: Vec2) -> Vec3 {
        let p = self.base + self.u * uv.x + self.v * uv.y;
        match &self.rest {
            RestSurface::Plane => p,
            RestSurface::Cone { cone, hint, sight } => self.on_cone(p, uv, (cone, *hint, *sight)),
            RestSurface::Shaped { cone, hint, sight, ways } => {
                self.on_cone(p, uv, (cone, *hint, *sight)) + self.way(ways.at(uv))
            }
            RestSurface::Patch(patch) => self.placed(patch.at(uv)),
            RestSurface::Ring(sheet) => self.placed(sheet.at(uv)),
        }
    }

    /// The place on a cone over `p` along the sight, which is (u, v) in the blade's plane.
    fn on_cone(&self, p: Vec3, uv: Vec2, (cone, hint, sight): (&Cone, f32, Vec3)) -> Vec3 {
        let share = (uv.y / self.template.length()).clamp(0.0, 1.0);
        if sight == Vec3::Z {
            let hint = cone.apex.z + (hint - cone.apex.z) * share;
            return Vec3::new(p.x, p.y, cone.depth_near(p.truncate(), hint));
        }
        // As if it were seen from the front.
        let turn = Quat::from_rotation_arc(sight, Vec3::Z);
        let front = Cone { apex: turn * cone.apex, axis: turn * cone.axis, ..*cone };
        let hint = front.apex.z + (hint - front.apex.z) * share;
        let p = (turn * p).truncate();
        turn.inverse() * p.extend(front.depth_near(p, hint))
    }

    /// World position of a point that is given along u, along v and toward the face.
    pub fn placed(&self, local: Vec3) -> Vec3 {
        self.base + self.way(local)
    }

    /// The way in the world that is given along u, along v and toward the face.
    fn way(&self, local: Vec3) -> Vec3 {
        let face = self.u.cross(self.v) / self.v.length().max(f32::MIN_POSITIVE);
        self.u * local.x + self.v * local.y + face * local.z
    }

    /// The blade before its places were moved on.
    pub fn unshaped(&self) -> Self
    where
        T: Clone,
    {
        let rest = match &self.rest {
            RestSurface::Shaped { cone, hint, sight, .. } => {
                RestSurface::Cone { cone: *cone, hint: *hint, sight: *sight }
            }
            other => other.clone(),
        };
        Self { rest, ..self.clone() }
    }

    /// World position of the tip on the rest surface.
    pub fn tip_at_rest(&self) -> Vec3 {
        self.at_rest(Vec2::new(0.0, self.template.length()))
    }
}
