//! Colour spaces: coordinates that follow from XYZ, each with its inverse.
//!
//! XYZ has Y = 1 for white unless a function says that it is absolute. White is the XYZ of the white point.

mod lab;
mod luv;
mod power;
mod ucs;
mod xyy;

pub(in crate::color) use lab::hue_degrees;
pub use lab::{lab_from_lch, lab_from_xyz, lch_from_lab, xyz_from_lab};
pub use luv::{luv_from_xyz, uv_1976_from_xyz, xy_from_uv_1976, xyz_from_luv, xyz_from_uv_1976_y};
pub use power::{
    igpgtg_from_xyz, ipt_from_xyz, ipt_ragoo2021_from_xyz, oklab_from_xyz, sucs_from_xyz, xyz_from_igpgtg,
    xyz_from_ipt, xyz_from_ipt_ragoo2021, xyz_from_oklab, xyz_from_sucs,
};
pub use ucs::{
    ucs_from_xyz, uv_1960_from_xyz, uvw_from_xyz, xy_from_uv_1960, xyz_from_ucs, xyz_from_uv_1960_y, xyz_from_uvw,
};
pub use xyy::{xyy_from_xyz, xyz_from_xyy};
