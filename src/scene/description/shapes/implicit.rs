//! Built-in implicit surfaces: closed solids with outward normals.

use super::super::codec::{Array, List, Number, Numbers, Object, Range, Variant};
use super::super::text::show;
use super::super::vector::POINT;
use super::{LENGTH, ShapeDescription};
use crate::geometry::implicit::{Gyroid, SmoothUnion, Superquadric, Tanglecube};
use crate::{ErrorKind, Result};

/// Built-in implicit surfaces; closed solids, outward normals.
#[derive(Debug, Clone, PartialEq)]
pub enum ImplicitDescription {
    /// Torus about the y axis.
    Torus {
        /// Centre line radius.
        major_radius: f64,
        /// Tube radius, < major_radius.
        minor_radius: f64,
    },
    /// (|x/a|^(2/e₂) + |z/c|^(2/e₂))^(e₂/e₁) + |y/b|^(2/e₁) = 1.
    Superquadric {
        /// Half axes a, b, c, metres.
        radii: [f64; 3],
        /// e₁: north–south, in [0.1, 2]; 1 is round, small is boxy, 2 is octahedral.
        exponent_y: f64,
        /// e₂: east–west, in [0.1, 2].
        exponent_xz: f64,
    },
    /// A gyroid wall of the given thickness, cut by a sphere about the origin.
    Gyroid {
        /// Period of the surface, metres.
        period: f64,
        /// Wall thickness, metres (to first order, where the gradient is largest and the wall thinnest), < period / 4.
        thickness: f64,
        /// Radius of the sphere that cuts it, metres, ≤ 100 periods.
        radius: f64,
    },
    /// Spheres melted into each other.
    SmoothUnion {
        /// Centres.
        centers: Vec<[f64; 3]>,
        /// Radii, one a centre.
        radii: Vec<f64>,
        /// Width of the blend, metres, ≥ 0.
        blend: f64,
    },
    /// A quartic "tangle cube": x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + level = 0 in units of `size`.
    Tanglecube {
        /// Length of one unit, metres.
        size: f64,
        /// The constant term, in [−100, 18.75); 11.8 by default.
        level: f64,
    },
}

#[rustfmt::skip] // one surface a paragraph
const SURFACES: &[Variant<ImplicitDescription>] = &[
    Variant { name: "torus", what: "a torus", doc: "A torus about the y axis.", read: torus },
    Variant { name: "superquadric", what: "a superquadric", read: superquadric,
              doc: "(|x/a|^(2/e₂) + |z/c|^(2/e₂))^(e₂/e₁) + |y/b|^(2/e₁) = 1 [Barr1981]." },
    Variant { name: "gyroid", what: "a gyroid", doc: "A wall along Schoen's gyroid, cut by a sphere.", read: gyroid },
    Variant { name: "smooth-union", what: "a smooth union", doc: "Spheres melted into each other.", read: smooth_union },
    Variant { name: "tanglecube", what: "a tanglecube", read: tanglecube,
              doc: "x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + level = 0, in units of `size`." },
];

pub fn read(o: &mut Object) -> Result<ShapeDescription> {
    Ok(ShapeDescription::Implicit(o.tagged("surface", SURFACES)?))
}

/// Refuses a value of `key` that is not below a limit, which `than` says in words.
fn less(o: &Object, key: &str, value: f64, than: &str, limit: f64) -> Result<()> {
    let found = || format!("expected less than {than}, {}, found {}", show(limit), show(value));
    o.refuse_if(value >= limit, ErrorKind::OutOfRange, key, found)
}

fn torus(o: &mut Object) -> Result<ImplicitDescription> {
    let major_radius = o.required("major_radius", LENGTH, "Radius of the centre line, metres.")?;
    let minor_radius = o.required("minor_radius", LENGTH, "Radius of the tube, metres; less than `major_radius`.")?;
    less(o, "minor_radius", minor_radius, "`major_radius`", major_radius)?;
    Ok(ImplicitDescription::Torus { major_radius, minor_radius })
}

fn superquadric(o: &mut Object) -> Result<ImplicitDescription> {
    let exponent = Number(Range::from_to(Superquadric::MIN_EXPONENT, Superquadric::MAX_EXPONENT));
    let doc = "e₁, north–south: 1 is round, 2 an octahedron's edge, towards 0 boxy.";
    Ok(ImplicitDescription::Superquadric {
        radii: o.required("radii", Array::of(Range::LENGTH), "Half axes along x, y, z, metres.")?,
        exponent_y: o.default("exponent_y", exponent, "1", doc)?,
        exponent_xz: o.default("exponent_xz", exponent, "1", "e₂, east–west, likewise.")?,
    })
}

fn gyroid(o: &mut Object) -> Result<ImplicitDescription> {
    let period = o.required("period", LENGTH, "Period of the surface, metres.")?;
    let doc = "Thickness of the wall, metres; less than a quarter of the period.";
    let thickness = o.required("thickness", LENGTH, doc)?;
    let doc = "Radius of the sphere about the origin that cuts it, metres; at most 100 periods.";
    let radius = o.required("radius", LENGTH, doc)?;
    less(o, "thickness", thickness, "a quarter of `period`", Gyroid::MAX_THICKNESS * period)?;
    let most = Gyroid::MAX_PERIODS * period;
    o.refuse_if(radius > most, ErrorKind::OutOfRange, "radius", || {
        format!("expected at most {} periods, {}, found {}", Gyroid::MAX_PERIODS, show(most), show(radius))
    })?;
    Ok(ImplicitDescription::Gyroid { period, thickness, radius })
}

fn smooth_union(o: &mut Object) -> Result<ImplicitDescription> {
    let centers = List { what: "a centre", item: POINT, min: 1, max: SmoothUnion::MAX_SPHERES };
    let centers = o.required("centers", centers, "Centres of the spheres, each [x, y, z], metres.")?;
    let radii = Numbers::several(1, SmoothUnion::MAX_SPHERES, Range::LENGTH);
    let radii = o.required("radii", radii, "Radii, one for each centre, metres.")?;
    let blend = o.default("blend", Number(Range::LENGTH_OR_ZERO), "0", "Width of the blend, metres.")?;
    o.refuse_if(centers.len() != radii.len(), ErrorKind::WrongType, "radii", || {
        format!("{} radii for {} centres; expected as many", radii.len(), centers.len())
    })?;
    Ok(ImplicitDescription::SmoothUnion { centers, radii, blend })
}

fn tanglecube(o: &mut Object) -> Result<ImplicitDescription> {
    let (least, limit) = Tanglecube::LEVELS;
    let level = Number(Range::from_below(least, limit));
    Ok(ImplicitDescription::Tanglecube {
        size: o.required("size", LENGTH, "Length of one unit of the equation, metres.")?,
        level: o.default("level", level, "11.8", "The constant term; the solid is empty from 18.75 on.")?,
    })
}
