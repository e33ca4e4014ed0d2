//! abbe: a spectral renderer and colour library.
//!
//! It traces wavelengths instead of RGB: light refracts through glass by the index that the glass has at its wavelength,
//! radiance is integrated with the CIE observer, and only the finished picture becomes RGB.
//!
//! ```no_run
//! fn main() -> abbe::Result<()> {
//!     let mut project = abbe::load("scenes/prism.json")?;
//!     project.render.samples_per_pixel = 64;
//!     let rendering = abbe::render(&project);
//!     let picture = rendering.film.develop(&project.develop);
//!     picture.save("prism.png")
//! }
//! ```
//!
//! The colour library stands alone:
//!
//! ```
//! use abbe::color::{Observer, RgbSpace, illuminant, xyz_of_emission};
//! # fn main() -> abbe::Result<()> {
//! let lamp = illuminant::by_name("FL11")?;
//! let xyz = xyz_of_emission(&lamp, Observer::cie_1931_2deg());
//! let rgb = RgbSpace::srgb().linear_from_xyz(xyz);
//! assert!((xyz.y - 1.0).abs() < 1e-9 && rgb.0.x > rgb.0.z);
//! # Ok(())
//! # }
//! ```
//!
//! # Features of the crate
//!
//! * `cli`, on by default: the command `abbe`.
//! * `render`, which `cli` needs: scenes, the renderer, developing, and files in and out.
//! * Neither, with `default-features = false`: [`color`], [`spectrum`], [`optics`], [`sampling`], and [`metrics`] with the
//!   [`Image`]s that they compare, which need four small crates.
//!
//! # The data flow is the architecture
//!
//! A render is a chain of immutable values, each made from the one before:
//!
//! ```text
//! scene.json ─parse─▶ SceneDescription ─compile─▶ Scene ─render─▶ Film ─develop─▶ Picture ─encode─▶ .png
//!             (names, the user's units)  (indices, one tree,  (XYZ sums in f64,   └─────encode─▶ .exr
//!                                         tables, unit size)    replicates)
//! ```
//!
//! [`load`], [`render()`](fn@render), `develop` and `save` go this way at once; each step is also there alone, in
//! [`scene::description`], [`scene::compile`], [`mod@render`], [`develop`] and [`io`].
//!
//! Modules use each other downwards only, which a test holds: `cli` → `render`, `develop`, `io` → `scene`, `film` → `bsdf`,
//! `optics`, `geometry`, `color` → `spectrum`, `sampling` → `math`. `render` never sees a description, and `color` never sees
//! rendering.
//!
//! # Conventions
//!
//! * Files are in metres, degrees and nanometres, Y-up, right-handed. Radiance is in W·m⁻²·sr⁻¹·nm⁻¹; a spectral radiance of 1
//!   everywhere has Y = 1. The film records radiance in the camera's medium: inside glass of index n a unit furnace reads n².
//! * A compiled scene is recentred and scaled by powers of two, in length and in radiance, so that no scale is special.
//! * Lengths of light are in nm and their names end in `_nm`.
//! * Matrices and transforms are named so that they cancel when read: `xyz_from_rgb * rgb`.
//! * `wo` points to where a path came from, `wi` to where it goes; both away from the surface.
//! * The wavelength density is divided by in one place: [`film::Sensor`].
//!
//! # Words
//!
//! Paths and wavelengths:
//!
//! * **Lane**: one of the eight wavelengths that a path carries.
//! * **Hero**: the lane that goes on where only one of them can.
//! * **Parting**: a refraction into directions that depend on the wavelength, after which lanes no longer share a ray.
//! * **Bundle**: the lanes that go on after a parting, each its own **way**.
//! * **Fork**: a smooth boundary at which a path follows both the reflected and the refracted light instead of drawing one.
//! * **Share**: how much of the light that a path started with one of its branches carries.
//! * **Vertex**: a point at which a path is scattered, with all that the next step must know.
//! * **Encounter**: what a path meets next: a vertex, a boundary that it passes, or nothing.
//! * **Odds**: the ratios between the wavelengths' densities along a path, which weigh them against each other.
//! * **Interior**: a transparent object that a path is inside of. Where several overlap, the one of highest **priority**
//!   counts.
//!
//! The work of a render:
//!
//! * **Round**: the samples of a pixel that are summed in a tile before they reach the film.
//! * **Pass**: some samples of every pixel and some light paths. Between passes progress is told and the render may stop.
//! * **Segment**: the passes between two decisions on how to split the work. Each is as long as all before it. (A segment of
//!   a path is the line between two of its vertices.)
//! * **Stage**: the samples of which adaptive sampling decides the distribution over pixels at once.
//! * **Replicate**: an independently scrambled part of the samples. The film learns its own error from how they differ.
//!
//! Sources are named by keys such as `[Wilkie2014]`; see [`references`].

#[cfg(feature = "render")]
pub mod bsdf;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
pub mod color;
#[cfg(feature = "render")]
pub mod develop;
mod error;
#[cfg(feature = "render")]
pub mod film;
#[cfg(feature = "render")]
pub mod geometry;
mod image;
#[cfg(feature = "render")]
pub mod io;
pub mod math;
pub mod metrics;
pub mod optics;
#[cfg(feature = "render")]
mod project;
pub mod references;
#[cfg(feature = "render")]
pub mod render;
pub mod sampling;
#[cfg(feature = "render")]
pub mod scene;
pub mod spectrum;

pub use self::image::Image;
pub use error::{Error, ErrorKind, Result, nearest_name};
#[cfg(feature = "render")]
pub use project::{DevelopSettings, Project, load, load_str, render};

/// Name and version of this program, as written into files.
pub const VERSION: &str = concat!("abbe ", env!("CARGO_PKG_VERSION"));
