//! What surfaces and volumes are made of, by index into the scene's tables.

use crate::optics::ior::IndexOfRefraction;

/// Index into [`Scene::spectra`](super::Scene::spectra).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct SpectrumId(pub u32);

/// Index into [`Scene::media`](super::Scene::media).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MediumId(pub u32);

/// A surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Material {
    /// Reflects nothing.
    Black,
    /// Lambertian.
    Diffuse {
        /// Reflectance.
        reflectance: SpectrumId,
    },
    /// Perfect mirror.
    Mirror {
        /// Reflectance.
        reflectance: SpectrumId,
    },
    /// Metal.
    Conductor {
        /// Real part of the index.
        eta: SpectrumId,
        /// Imaginary part.
        k: SpectrumId,
        /// GGX α; 0 is smooth.
        alpha: f32,
    },
    /// The boundary of a transparent volume.
    Dielectric {
        /// What is inside.
        medium: MediumId,
        /// GGX α; 0 is smooth.
        alpha: f32,
    },
}

/// Roughness from which on a surface no longer counts as focusing light: lobes as wide as that are found by camera paths
/// as well as by light paths.
pub const LARGEST_FOCUSING_ALPHA: f32 = 0.5;

impl Material {
    /// Whether light is scattered into single directions only.
    pub fn is_specular(&self) -> bool {
        match *self {
            Self::Mirror { .. } => true,
            Self::Conductor { alpha, .. } | Self::Dielectric { alpha, .. } => alpha == 0.0,
            Self::Black | Self::Diffuse { .. } => false,
        }
    }

    /// Whether light is scattered into so small a part of all directions that it can make caustics.
    pub fn focuses(&self) -> bool {
        match *self {
            Self::Mirror { .. } => true,
            Self::Conductor { alpha, .. } | Self::Dielectric { alpha, .. } => alpha < LARGEST_FOCUSING_ALPHA,
            Self::Black | Self::Diffuse { .. } => false,
        }
    }

    /// The volume behind the surface, if it is the boundary of one.
    pub fn medium(&self) -> Option<MediumId> {
        match *self {
            Self::Dielectric { medium, .. } => Some(medium),
            Self::Black | Self::Diffuse { .. } | Self::Mirror { .. } | Self::Conductor { .. } => None,
        }
    }

    /// GGX α; 0 where the surface is smooth, or has none.
    pub fn alpha(&self) -> f32 {
        match *self {
            Self::Conductor { alpha, .. } | Self::Dielectric { alpha, .. } => alpha,
            Self::Black | Self::Diffuse { .. } | Self::Mirror { .. } => 0.0,
        }
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
