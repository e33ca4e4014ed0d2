//! The colour of a green paint in daylight, from its reflectance to sRGB. Needs no feature of the crate.

use abbe::color::{Observer, RgbSpace, illuminant, xyz_of_reflectance};
use abbe::spectrum::{PiecewiseLinear, Spectrum};

fn main() -> abbe::Result<()> {
    let paint = PiecewiseLinear::new(vec![400.0, 480.0, 530.0, 600.0, 700.0], vec![0.05, 0.2, 0.6, 0.15, 0.1])?;
    let daylight = illuminant::by_name("D65")?;
    let xyz = xyz_of_reflectance(&Spectrum::PiecewiseLinear(paint), &daylight, Observer::cie_1931_2deg());
    let srgb = RgbSpace::srgb();
    println!("XYZ {xyz:.4}, sRGB {:.3?}", srgb.encode(srgb.linear_from_xyz(xyz)).to_array());
    Ok(())
}
