//! What happens at a surface and in a material: indices of refraction, Snell, Fresnel, Beer–Lambert. Pure functions.

mod absorption;
mod conductor;
mod dielectric;
pub mod dispersion;
pub mod ior;
pub mod table;

pub use absorption::transmittance;
pub use conductor::fresnel_conductor;
pub use dielectric::{Refraction, reflect, refract};
