//! Lights without a shape, and the environment.

use super::JsonPath;
use super::codec::{Number, Object, Range, Record, Variant};
use super::shapes::LENGTH;
use super::spectrum::{EMISSION, SpectrumDescription};
use super::vector::{DIRECTION, POINT};
use crate::{ErrorKind, Result};

/// A light without a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct LightDescription {
    /// The kind with its parameters.
    pub kind: LightKind,
    /// Name for messages.
    pub name: Option<String>,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The kinds of light without a shape.
#[derive(Debug, Clone, PartialEq)]
pub enum LightKind {
    /// Equal intensity in every direction.
    Point {
        /// Position, metres.
        position: [f64; 3],
        /// W·sr⁻¹·nm⁻¹.
        intensity: SpectrumDescription,
    },
    /// A cone with a smooth edge.
    Spot {
        /// Position, metres.
        position: [f64; 3],
        /// Axis.
        direction: [f64; 3],
        /// On the axis, W·sr⁻¹·nm⁻¹.
        intensity: SpectrumDescription,
        /// Half angle of full intensity, degrees.
        inner_degrees: f64,
        /// Half angle where it ends, degrees.
        outer_degrees: f64,
    },
    /// Parallel light from infinitely far away, or from a disc like the sun's.
    Directional {
        /// Direction of travel.
        direction: [f64; 3],
        /// On a plane facing it, W·m⁻²·nm⁻¹.
        irradiance: SpectrumDescription,
        /// Full angle of the disc; 0 for exactly parallel light.
        angular_diameter_degrees: f64,
    },
    /// A collimated beam of circular section.
    Beam {
        /// Centre of the disc it starts from, metres.
        origin: [f64; 3],
        /// Direction of travel.
        direction: [f64; 3],
        /// Radius, metres.
        radius: f64,
        /// W·nm⁻¹.
        power: SpectrumDescription,
    },
}

/// Light from infinitely far away, the same from every direction.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentDescription {
    /// Radiance.
    pub radiance: SpectrumDescription,
    /// Its place in the file.
    pub at: JsonPath,
}

#[rustfmt::skip] // one light a line
const LIGHTS: &[Variant<LightKind>] = &[
    Variant { name: "point", what: "a point light", doc: "Equal intensity in every direction.", read: point },
    Variant { name: "spot", what: "a spot light", doc: "A cone with a smooth edge.", read: spot },
    Variant { name: "directional", what: "a directional light", doc: "Light from infinitely far away.", read: directional },
    Variant { name: "beam", what: "a beam", doc: "A collimated beam of circular section.", read: beam },
];

/// A light without a shape.
pub const LIGHT: Record<LightDescription> = Record { what: "a light", doc: "A light without a shape.", read: light };

/// Light from infinitely far away.
pub const ENVIRONMENT: Record<EnvironmentDescription> = Record {
    what: "an environment",
    doc: "Light from infinitely far away, the same from every direction.",
    read: environment,
};

const HALF_ANGLE: Number = Number(Range::from_to(0.0, 180.0));

fn light(o: &mut Object) -> Result<LightDescription> {
    let kind = o.tagged("type", LIGHTS)?;
    Ok(LightDescription { kind, name: o.name()?, at: o.at() })
}

fn environment(o: &mut Object) -> Result<EnvironmentDescription> {
    let doc = "Radiance from every direction, W·m⁻²·sr⁻¹·nm⁻¹.";
    let radiance = o.required("radiance", EMISSION, doc)?;
    o.name()?;
    Ok(EnvironmentDescription { radiance, at: o.at() })
}

fn position(o: &mut Object) -> Result<[f64; 3]> {
    o.required("position", POINT, "Position, metres.")
}

fn direction(o: &mut Object) -> Result<[f64; 3]> {
    o.required("direction", DIRECTION, "Direction of travel, of any length but 0.")
}

fn point(o: &mut Object) -> Result<LightKind> {
    Ok(LightKind::Point {
        position: position(o)?, intensity: o.required("intensity", EMISSION, "W·sr⁻¹·nm⁻¹.")?
    })
}

fn spot(o: &mut Object) -> Result<LightKind> {
    let (position, direction) = (position(o)?, direction(o)?);
    let intensity = o.required("intensity", EMISSION, "Intensity on the axis, W·sr⁻¹·nm⁻¹.")?;
    let inner_degrees = o.required("inner_degrees", HALF_ANGLE, "Half angle of full intensity, degrees.")?;
    let doc = "Half angle where the light ends, degrees; at least `inner_degrees`.";
    let outer_degrees = o.required("outer_degrees", HALF_ANGLE, doc)?;
    let wrong = inner_degrees > outer_degrees || outer_degrees == 0.0;
    o.refuse_if(wrong, ErrorKind::OutOfRange, "outer_degrees", || {
        format!("expected more than 0 and at least `inner_degrees`, {inner_degrees}, found {outer_degrees}")
    })?;
    Ok(LightKind::Spot { position, direction, intensity, inner_degrees, outer_degrees })
}

fn directional(o: &mut Object) -> Result<LightKind> {
    let doc = "Full angle of the disc, degrees; 0.53 is the sun, 0 parallel light.";
    Ok(LightKind::Directional {
        direction: direction(o)?,
        irradiance: o.required("irradiance", EMISSION, "On a plane facing the light, W·m⁻²·nm⁻¹.")?,
        angular_diameter_degrees: o.default("angular_diameter_degrees", HALF_ANGLE, "0", doc)?,
    })
}

fn beam(o: &mut Object) -> Result<LightKind> {
    Ok(LightKind::Beam {
        origin: o.required("origin", POINT, "Centre of the disc it starts from, metres.")?,
        direction: direction(o)?,
        radius: o.required("radius", LENGTH, "Radius, metres.")?,
        power: o.required("power", EMISSION, "W·nm⁻¹.")?,
    })
}
