//! Light quality: how well a light shows colours, and how like a spectrum is to another.
//!
//! * [`cri`]: the CIE colour rendering index Ra and R1 to R14 \[CIE13.3\], and R15.
//! * [`cqs`]: the NIST colour quality scale, versions 7.4 and 9.0 \[Davis2010\].
//! * [`fidelity`]: the CIE 2017 colour fidelity index \[CIE224\].
//! * [`tm30`]: ANSI/IES TM-30-18, the same with gamut, chroma and hue in 16 bins \[TM30\].
//! * [`ssi`]: the Academy's spectral similarity index \[SSI2020\].
//!
//! # How spectra are read
//!
//! These indices are defined as sums at equal steps, and their published values depend on them. So a light is not integrated
//! exactly here, but evaluated at the wavelengths of the sums, tables by straight lines. Where it is finer than 1 nm, as
//! lines are, its mean around each wavelength is taken instead, weighted by a triangle, so that no power is lost. The
//! samples' reflectances are interpolated by Sprague's quintic polynomials \[CIE167\].
//!
//! [`cri`] and [`cqs`] sum at 1 nm over 360–780 nm and hold tables constant beyond their ends; [`fidelity`] and [`tm30`] sum
//! over 380–780 nm at 5 nm for tables at 5 nm, at 1 nm for all others, and take what is missing for 0, as the standard says.
//! Exact integrals instead of sums would change Ra of the CIE illuminants by at most 0.021 (HP1), of
//! most of them by less than 0.003.
//! The scale of a light does not matter.
//!
//! ```
//! use abbe::color::{illuminant, quality};
//! let fl2 = illuminant::by_name("FL2")?;
//! assert!((quality::cri(&fl2)?.ra - 64.2337).abs() < 1e-4);
//! assert!((quality::fidelity(&fl2)?.rf - 70.1208).abs() < 1e-4);
//! # Ok::<(), abbe::Error>(())
//! ```

mod cqs;
mod cri;
mod fidelity;
mod reference;
mod sampling;
mod ssi;
mod tm30;

pub use cqs::{Cqs, CqsVersion, cqs};
pub use cri::{Cri, cri, cri_against};
pub use fidelity::{Fidelity, fidelity};
pub use ssi::ssi;
pub use tm30::{HueBin, Tm30, tm30};
