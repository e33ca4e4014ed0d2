//! What surfaces and volumes are made of, by index into the scene's tables. Each material is a struct in a file of its own
//! that states its capabilities; [`Material`] forwards. The rest of the crate asks for capabilities, not for names.

mod black;
mod capabilities;
mod conductor;
mod dielectric;
mod diffuse;
mod mirror;
mod parameter;

pub use black::Black;
pub use conductor::ConductorMaterial;
pub use dielectric::DielectricMaterial;
pub use diffuse::DiffuseMaterial;
pub use mirror::MirrorMaterial;
pub use parameter::Parameter;

use crate::optics::ior::IndexOfRefraction;
use crate::scene::{MediumId, SpectrumId};
use capabilities::Capabilities;

/// A surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Material {
    /// Reflects nothing.
    Black(Black),
    /// Lambertian.
    Diffuse(DiffuseMaterial),
    /// Perfect mirror.
    Mirror(MirrorMaterial),
    /// Metal.
    Conductor(ConductorMaterial),
    /// The boundary of a transparent volume.
    Dielectric(DielectricMaterial),
}

/// Calls the same method of whichever material it is.
macro_rules! for_material {
    ($materials:expr, $material:ident => $body:expr) => {
        match $materials {
            Material::Black($material) => $body,
            Material::Diffuse($material) => $body,
            Material::Mirror($material) => $body,
            Material::Conductor($material) => $body,
            Material::Dielectric($material) => $body,
        }
    };
}

impl Material {
    /// Whether light is scattered into single directions only.
    pub fn is_specular(&self) -> bool {
        for_material!(self, material => material.is_specular())
    }

    /// Whether light is scattered into so small a part of all directions that it can make caustics.
    pub fn focuses(&self) -> bool {
        for_material!(self, material => material.focuses())
    }

    /// Whether it scatters about interpolated normals where a mesh has them.
    #[inline]
    pub fn uses_shading_normals(&self) -> bool {
        for_material!(self, material => material.uses_shading_normals())
    }

    /// What is inside, if this is the boundary of a transparent volume.
    #[inline]
    pub fn medium(&self) -> Option<MediumId> {
        for_material!(self, material => material.medium())
    }
}

/// A transparent volume.
#[derive(Debug, Clone, PartialEq)]
pub struct Medium {
    /// Relative to air.
    pub ior: IndexOfRefraction,
    /// Whether the index depends on the wavelength.
    pub dispersive: bool,
    /// Absorption coefficient per unit of the compiled scene's length.
    pub absorption: Option<SpectrumId>,
    /// Where volumes overlap, the highest priority is what is there.
    pub priority: i32,
}
