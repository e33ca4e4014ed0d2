//! What happens at a smooth surface and inside a material: Snell, Fresnel, Beer–Lambert. Pure functions.

mod absorption;
mod conductor;
mod dielectric;

pub use absorption::transmittance;
pub use conductor::fresnel_conductor;
pub use dielectric::{Refraction, reflect, refract};
