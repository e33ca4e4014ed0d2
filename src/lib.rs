//! abbe: a spectral renderer and colour library.
//!
//! It traces wavelengths instead of RGB: light refracts through glass by the index that the glass has at its wavelength,
//! radiance is integrated with the CIE observer, and only the finished picture becomes RGB.
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
//! ```
//! use abbe::scene::{SceneFeatures, compile, description};
//! # fn main() -> abbe::Result<()> {
//! let text = r#"{
//!     "camera": { "type": "perspective", "from": [0, 0, 4], "to": [0, 0, 0] },
//!     "film": { "width": 8, "height": 8 },
//!     "render": { "samples_per_pixel": 4 },
//!     "materials": { "glass": { "type": "dielectric", "ior": { "glass": "N-BK7" } } },
//!     "objects": [ { "shape": { "type": "sphere", "center": [0, 0, 0], "radius": 1 }, "material": "glass" } ],
//!     "environment": { "radiance": { "illuminant": "D65" } }
//! }"#;
//! let parsed = description::parse_str(text, "example.json".as_ref())?;
//! let compiled = compile(&parsed.description)?;
//! let needed = SceneFeatures { dispersion: false, interiors: false };
//! let (film, statistics) = abbe::render::render(&compiled.scene, &compiled.render, &compiled.film, needed, &mut |_| true);
//! assert_eq!((statistics.camera_paths, film.non_finite_samples), (256, 0));
//! let picture = abbe::develop::develop(&film.to_xyz(), film.width(), None, abbe::develop::Tonemap::Srgb);
//! assert_eq!(picture.rgb8.len(), 64);
//! # Ok(())
//! # }
//! ```
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
//! * A **lane** is one of the eight wavelengths that a path carries; the **hero** is the lane that goes on where a
//!   wavelength-dependent refraction parts them.
//! * An **interior** is a transparent object that a path is inside of; where several overlap the highest **priority** is
//!   there.
//! * A **replicate** is an independently scrambled part of the samples, from which the film knows its own error.
//!
//! # References
//!
//! * `[Andersson2020]` P. Andersson et al., FLIP: a difference evaluator for alternating images, Proc. ACM CGIT 3(2), 2020.
//! * `[Barr1981]` A. H. Barr, Superquadrics and angle-preserving transformations, IEEE CG&A 1(1), 1981.
//! * `[BornWolf1999]` M. Born and E. Wolf, Principles of Optics, 7th edition, 1999.
//! * `[Burley2020]` B. Burley, Practical hash-based Owen scrambling, JCGT 9(4), 2020.
//! * `[Burns2019]` S. A. Burns, Numerical methods for smoothest reflectance reconstruction, Color Res. Appl. 45, 2019.
//! * `[CIE15]` CIE 015:2018, Colorimetry, 4th edition.
//! * `[DLMF]` NIST Digital Library of Mathematical Functions, chapter 8, release 1.2, 2024.
//! * `[Duff2017]` T. Duff et al., Building an orthonormal basis, revisited, JCGT 6(1), 2017.
//! * `[Fichet2021]` A. Fichet, R. Pacanowski, A. Wilkie, An OpenEXR layout for spectral images, JCGT 10(3), 2021.
//! * `[Haines2019]` E. Haines et al., Precision improvements for ray/sphere intersection, Ray Tracing Gems 7, 2019.
//! * `[Harris1978]` F. J. Harris, On the use of windows for harmonic analysis with the DFT, Proc. IEEE 66(1), 1978.
//! * `[Heitz2019]` E. Heitz, A low-distortion map between triangle and square, 2019.
//! * `[Higham2002]` N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd edition, 2002.
//! * `[Hyndman1996]` R. J. Hyndman and Y. Fan, Sample quantiles in statistical packages, Am. Stat. 50(4), 1996.
//! * `[IEC61966]` IEC 61966-2-1, Default RGB colour space – sRGB, 1999.
//! * `[ISO7944]` ISO 7944, Optics and optical instruments – Reference wavelengths, 1998.
//! * `[Ize2013]` T. Ize, Robust BVH ray traversal, JCGT 2(2), 2013.
//! * `[JoeKuo2008]` S. Joe and F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J.
//!   Sci. Comput. 30(5), 2008.
//! * `[LaineKarras2011]` S. Laine and T. Karras, Stratified sampling for stochastic transparency, CGF 30(4), 2011.
//! * `[Lam1985]` K. M. Lam, Metamerism and colour constancy, PhD thesis, Bradford, 1985.
//! * `[Mitchell1990]` D. P. Mitchell, Robust ray intersection with interval arithmetic, Graphics Interface, 1990.
//! * `[Moore2009]` R. E. Moore et al., Introduction to Interval Analysis, 2009.
//! * `[PBRT4]` M. Pharr, W. Jakob, G. Humphreys, Physically Based Rendering, 4th edition, 2023.
//! * `[Planck1901]` M. Planck, Über das Gesetz der Energieverteilung im Normalspectrum, Ann. Phys. 309, 1901.
//! * `[Polyanskiy2024]` M. N. Polyanskiy, Refractiveindex.info database of optical constants, Sci. Data 11, 2024.
//! * `[Quilez2013]` I. Quilez, Smooth minimum, 2013.
//! * `[Reinhard2002]` E. Reinhard et al., Photographic tone reproduction for digital images, SIGGRAPH, 2002.
//! * `[Rodrigues1840]` O. Rodrigues, Des lois géométriques qui régissent les déplacements d'un système solide, 1840.
//! * `[Rousselle2011]` F. Rousselle, C. Knaus, M. Zwicker, Adaptive sampling and reconstruction using greedy error
//!   minimization, ACM TOG 30(6), 2011.
//! * `[SI2019]` BIPM, The International System of Units, 9th edition, 2019.
//! * `[Schoen1970]` A. H. Schoen, Infinite periodic minimal surfaces without self-intersections, NASA TN D-5541, 1970.
//! * `[ShirleyChiu1997]` P. Shirley and K. Chiu, A low distortion map between disk and square, JGT 2(3), 1997.
//! * `[Steele2014]` G. L. Steele et al., Fast splittable pseudorandom number generators, OOPSLA, 2014.
//! * `[TM27]` ANSI/IES TM-27, IES standard format for the electronic transfer of spectral data, 2020.
//! * `[Tolkowsky1919]` M. Tolkowsky, Diamond Design, 1919.
//! * `[Turk1994]` G. Turk, The PLY polygon file format, 1994.
//! * `[Veach1997]` E. Veach, Robust Monte Carlo methods for light transport simulation, PhD thesis, Stanford, 1997.
//! * `[Vegdahl2021]` N. Vegdahl, Building a better LK hash, 2021.
//! * `[Vose1991]` M. D. Vose, A linear algorithm for generating random numbers with a given distribution, IEEE TSE 17(9), 1991.
//! * `[Wald2007]` I. Wald, On fast construction of SAH-based bounding volume hierarchies, IEEE RT, 2007.
//! * `[Wald2008]` I. Wald et al., Getting rid of packets, IEEE RT, 2008.
//! * `[Wavefront1995]` Wavefront Technologies, Advanced Visualizer Manual, appendix B1, object files, 1995.
//! * `[Wilkie2014]` A. Wilkie et al., Hero wavelength spectral sampling, CGF 33(4), 2014.
//! * `[Woop2013]` S. Woop, C. Benthin, I. Wald, Watertight ray/triangle intersection, JCGT 2(1), 2013.
//! * `[Ylitie2017]` H. Ylitie et al., Efficient incoherent ray traversal on GPUs through compressed wide BVHs, HPG, 2017.

pub mod bsdf;
pub mod cli;
pub mod color;
pub mod develop;
mod error;
pub mod film;
pub mod geometry;
pub mod io;
pub mod math;
pub mod metrics;
pub mod optics;
pub mod render;
pub mod sampling;
pub mod scene;
pub mod spectrum;

pub use error::{Error, ErrorKind, Result, nearest_name};

/// Name and version of this program, as written into files.
pub const VERSION: &str = concat!("abbe ", env!("CARGO_PKG_VERSION"));
