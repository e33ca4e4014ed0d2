//! Materials.

use super::JsonPath;
use super::codec::{Array, Bool, Checked, Integer, Map, Name, NumberOr, Object, Range, Record, Value, Variant};
use super::ior::{Ior, IorDescription};
use super::spectrum::{REFLECTANCE, Role, Spectrum, SpectrumDescription};
use crate::{ErrorKind, Result};

/// A material.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialDescription {
    /// What kind, with its parameters.
    pub kind: MaterialKind,
    /// Whether the back side scatters like the front; true by default where it applies.
    pub two_sided: bool,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The kinds of material.
#[derive(Debug, Clone, PartialEq)]
pub enum MaterialKind {
    /// Lambertian reflection.
    Diffuse {
        /// Reflectance in [0, 1].
        reflectance: SpectrumDescription,
    },
    /// Perfect mirror.
    Mirror {
        /// Reflectance in [0, 1].
        reflectance: SpectrumDescription,
    },
    /// Metal.
    Conductor {
        /// Its complex index.
        index: ConductorDescription,
        /// GGX α in [0, 1]; 0 is smooth.
        roughness: f64,
    },
    /// Transparent solid.
    Dielectric {
        /// Index of refraction, relative to air.
        ior: IorDescription,
        /// GGX α in [0, 1]; 0 is smooth.
        roughness: f64,
        /// Absorption inside, per metre.
        absorption_per_m: Option<SpectrumDescription>,
        /// The higher wins where volumes overlap.
        priority: i32,
    },
}

/// The complex index of a metal.
#[derive(Debug, Clone, PartialEq)]
pub enum ConductorDescription {
    /// A metal of data/metals by name.
    Metal(String),
    /// Given spectra.
    EtaK {
        /// Real part.
        eta: SpectrumDescription,
        /// Imaginary part.
        k: SpectrumDescription,
    },
}

/// A kind of material, and whether both sides scatter.
type Kind = (MaterialKind, bool);

#[rustfmt::skip] // one material a line
const MATERIALS: &[Variant<Kind>] = &[
    Variant { name: "diffuse", what: "a diffuse material", doc: "Lambertian reflection.", read: diffuse },
    Variant { name: "mirror", what: "a mirror", doc: "A perfect mirror.", read: mirror },
    Variant { name: "conductor", what: "a conductor", doc: "A metal by its complex index of refraction.", read: conductor },
    Variant { name: "dielectric", what: "a dielectric", doc: "A transparent solid.", read: dielectric },
];

/// Materials by name.
pub const NAMED_MATERIALS: Map<Record<MaterialDescription>> = Map {
    what: "a material",
    item: Record { what: "a material", doc: "How a surface scatters light.", read: material },
};

fn material(o: &mut Object) -> Result<MaterialDescription> {
    let (kind, two_sided) = o.tagged("type", MATERIALS)?;
    o.name()?;
    Ok(MaterialDescription { kind, two_sided, at: o.at() })
}

fn diffuse(o: &mut Object) -> Result<Kind> {
    Ok((MaterialKind::Diffuse { reflectance: reflectance(o)? }, two_sided(o)?))
}

fn mirror(o: &mut Object) -> Result<Kind> {
    Ok((MaterialKind::Mirror { reflectance: reflectance(o)? }, two_sided(o)?))
}

fn conductor(o: &mut Object) -> Result<Kind> {
    const INDEX: Spectrum = Spectrum(Role::Index);
    let index = o.one_of(&[&["metal"], &["eta", "k"]], |o, set| match set {
        0 => Ok(ConductorDescription::Metal(o.required(
            "metal",
            Name("a metal of the library"),
            "A metal by name; instead of eta and k.",
        )?)),
        _ => Ok(ConductorDescription::EtaK {
            eta: o.required("eta", INDEX, "Real part of the complex index.")?,
            k: o.required("k", INDEX, "Imaginary part of the complex index.")?,
        }),
    })?;
    Ok((MaterialKind::Conductor { index, roughness: roughness(o)? }, two_sided(o)?))
}

fn dielectric(o: &mut Object) -> Result<Kind> {
    let absorption = Spectrum(Role::Absorption);
    let priority = Integer { min: i32::MIN.into(), max: i32::MAX.into() };
    let kind = MaterialKind::Dielectric {
        ior: o.required("ior", Ior, "Index of refraction relative to air.")?,
        roughness: roughness(o)?,
        absorption_per_m: o.optional("absorption_per_m", absorption, "Absorption coefficient inside, per metre.")?,
        priority: o.default(
            "priority",
            priority,
            "0",
            "Where volumes overlap the higher wins; ties are won by the object entered last.",
        )? as i32,
    };
    Ok((kind, false))
}

fn reflectance(o: &mut Object) -> Result<SpectrumDescription> {
    o.required("reflectance", REFLECTANCE, "Reflectance in [0, 1].")
}

fn two_sided(o: &mut Object) -> Result<bool> {
    o.default("two_sided", Bool, "true", "Whether the back side scatters like the front.")
}

/// GGX α. Shapes have no directions along them so far, which [αx, αy] would refer to.
fn roughness(o: &mut Object) -> Result<f64> {
    let pair = NumberOr { range: Range::FRACTION, from_number: |alpha| [alpha; 2], other: Array::of(Range::FRACTION) };
    let alpha = Checked { codec: pair, check: check_isotropic };
    let doc = "GGX alpha, or [ax, ay], which must be equal in this version; 0 is smooth.";
    Ok(o.default("roughness", alpha, "0", doc)?[0])
}

fn check_isotropic(value: &Value, [x, y]: &[f64; 2]) -> Result<()> {
    if x == y {
        return Ok(());
    }
    let message = format!(
        "anisotropic roughness [{x}, {y}] is not supported yet, as surfaces have no directions to which it could refer; \
         expected one number, or two equal ones"
    );
    Err(value.error(ErrorKind::Unsupported, message))
}
