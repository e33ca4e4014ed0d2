//! What happens at a surface and in a material: index of refraction and dispersion.

pub mod dispersion;
pub mod ior;
pub mod table;
