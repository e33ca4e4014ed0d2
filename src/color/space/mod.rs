//! Colour spaces: coordinates that follow from XYZ, each with its inverse.
//!
//! XYZ has Y = 1 for white unless a function says that it is absolute. White is the XYZ of the white point. Every space is a
//! pair of functions; [`by_name`] finds it as a [`Space`] of one form, for choices made at run time.

mod din99;
mod hdr;
mod hunter;
mod lab;
mod luv;
mod names;
mod osa_ucs;
mod power;
mod pq;
mod prolab;
mod ucs;
mod xyy;
mod yrg;

pub use din99::{Din99, Din99Factors, din99_from_lab, lab_from_din99};
pub use hdr::{HdrConditions, hdr_cielab_from_xyz, hdr_ipt_from_xyz, xyz_from_hdr_cielab, xyz_from_hdr_ipt};
pub use hunter::{
    hunter_coefficients, hunter_lab_from_xyz, hunter_rdab_from_xyz, xyz_from_hunter_lab, xyz_from_hunter_rdab,
};
pub(in crate::color) use lab::hue_degrees;
pub use lab::{lab_from_lch, lab_from_xyz, lch_from_lab, xyz_from_lab};
pub use luv::{luv_from_xyz, uv_1976_from_xyz, xy_from_uv_1976, xyz_from_luv, xyz_from_uv_1976_y};
pub use names::{Space, by_name, names};
pub use osa_ucs::{osa_ucs_from_xyz, xyz_from_osa_ucs};
pub(in crate::color) use power::OKLAB_CONES_FROM_XYZ;
pub use power::{
    igpgtg_from_xyz, ipt_from_xyz, ipt_ragoo2021_from_xyz, oklab_from_xyz, sucs_from_xyz, xyz_from_igpgtg,
    xyz_from_ipt, xyz_from_ipt_ragoo2021, xyz_from_oklab, xyz_from_sucs,
};
pub use pq::{icacb_from_xyz, ictcp_from_xyz, jzazbz_from_xyz, xyz_from_icacb, xyz_from_ictcp, xyz_from_jzazbz};
pub use prolab::{prolab_from_xyz, xyz_from_prolab};
pub use ucs::{
    ucs_from_xyz, uv_1960_from_xyz, uvw_from_xyz, xy_from_uv_1960, xyz_from_ucs, xyz_from_uv_1960_y, xyz_from_uvw,
};
pub use xyy::{xyy_from_xyz, xyz_from_xyy};
pub use yrg::{xyz_from_yrg, yrg_from_xyz};
