//! What a chromaticity says about its light: wavelength, purity, whiteness, and how bright a surface of it can be.

mod dominant;
mod optimal;
mod purity;
mod whiteness;
mod yellowness;

pub use dominant::{Dominant, complementary_wavelength, dominant_wavelength, is_within_locus};
pub use optimal::{OptimalColor, OptimalColors};
pub use purity::{colorimetric_purity, excitation_purity};
pub use whiteness::{
    Field, Whiteness, whiteness_astm_e313, whiteness_berger1959, whiteness_cie2004, whiteness_ganz1979,
    whiteness_stensby1968, whiteness_stensby1968_from_xyz, whiteness_taube1960,
};
pub use yellowness::{
    YellownessIlluminant, yellowness_astm_d1925, yellowness_astm_e313, yellowness_astm_e313_alternative,
    yellowness_astm_e313_with,
};
