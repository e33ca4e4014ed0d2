//! The plain data types of a scene description. Field for field what the file says, with its defaults filled in.

use std::path::PathBuf;

/// Where in the file a value stands, as a JSON path such as `objects[2].shape.radius`.
pub type JsonPath = String;

/// A whole scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneDescription {
    /// The file it was read from; relative paths inside are relative to its folder.
    pub file: PathBuf,
    /// The camera.
    pub camera: CameraDescription,
    /// Picture size and reconstruction filter.
    pub film: FilmDescription,
    /// Sampling and integrator.
    pub render: RenderDescription,
    /// Named spectra, in file order.
    pub spectra: Vec<(String, SpectrumDescription)>,
    /// Named materials, in file order.
    pub materials: Vec<(String, MaterialDescription)>,
    /// Shapes with their materials.
    pub objects: Vec<ObjectDescription>,
    /// Lights without a shape of their own.
    pub lights: Vec<LightDescription>,
    /// Radiance from infinitely far away.
    pub environment: Option<EnvironmentDescription>,
    /// How the film becomes a picture.
    pub develop: DevelopDescription,
}

/// A perspective camera: pinhole if `aperture_radius` is 0, else a thin lens.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraDescription {
    /// Position of the pinhole or lens centre, metres.
    pub from: [f64; 3],
    /// Point looked at, metres.
    pub to: [f64; 3],
    /// Direction that is up in the picture.
    pub up: [f64; 3],
    /// Field of view along `fov_axis`, degrees in (0, 180).
    pub fov_degrees: f64,
    /// The axis that `fov_degrees` spans.
    pub fov_axis: FovAxis,
    /// Lens radius, metres.
    pub aperture_radius: f64,
    /// Distance of the plane in focus, metres; |to − from| by default.
    pub focus_distance: f64,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The axis of the picture that the field of view spans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FovAxis {
    /// Horizontal.
    X,
    /// Vertical.
    Y,
}

/// Picture size in pixels and the reconstruction filter.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmDescription {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Filter shape.
    pub filter: FilterKind,
    /// Filter radius, pixels.
    pub filter_radius: f64,
    /// Name of the observer whose XYZ is recorded.
    pub observer: String,
}

/// Reconstruction filters.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilterKind {
    /// Constant inside the radius (default, radius 0.5).
    Box,
    /// Gaussian cut at the radius (default radius 1.5; standard deviation radius / 3).
    Gaussian,
    /// Blackman–Harris window over the radius (default radius 1.5).
    BlackmanHarris,
}

/// Sampling options.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderDescription {
    /// Camera paths per pixel.
    pub samples_per_pixel: u64,
    /// Largest number of scattering events on a path.
    pub max_depth: u32,
    /// Seed of every random sequence.
    pub seed: u64,
    /// Light transport technique.
    pub integrator: Integrator,
}

/// Light transport techniques.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integrator {
    /// Each class of paths by the technique that suits it.
    Auto,
    /// Camera paths with next-event estimation.
    Path,
    /// Light paths, splatted onto the film.
    Light,
    /// Photon merging.
    Merge,
    /// Baseline: hero wavelengths as in pbrt-v4.
    Hero,
}

/// A spectrum as written, with the optional factor `scale`.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectrumDescription {
    /// The form.
    pub kind: SpectrumKind,
    /// Factor, 1 by default.
    pub scale: f64,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The forms a spectrum can be written in.
#[derive(Debug, Clone, PartialEq)]
pub enum SpectrumKind {
    /// The same value at every wavelength.
    Constant(f64),
    /// One of `spectra`; known to exist and to be free of cycles after parsing.
    Named(String),
    /// Piecewise linear; wavelengths ascend strictly.
    Tabulated {
        /// Wavelengths, nm.
        wavelengths_nm: Vec<f64>,
        /// Values there.
        values: Vec<f64>,
    },
    /// A CSV, .spd or .spdx file, relative to the scene file.
    File(PathBuf),
    /// A colour to be upsampled.
    Rgb {
        /// Linear components.
        rgb: [f64; 3],
        /// RGB colour space by name; "srgb" by default.
        space: String,
    },
    /// A standard illuminant by name, normalised to Y = 1.
    Illuminant(String),
    /// Planck's law.
    Blackbody {
        /// Temperature, kelvin.
        kelvin: f64,
        /// Whether to scale to Y = 1; absolute radiance otherwise.
        normalize: bool,
    },
    /// A Gaussian line of unit area.
    Line {
        /// Centre, nm.
        line_nm: f64,
        /// Full width at half maximum, nm.
        fwhm_nm: f64,
    },
}

/// An index of refraction as written.
#[derive(Debug, Clone, PartialEq)]
pub struct IorDescription {
    /// The form.
    pub kind: IorKind,
    /// `"extrapolate": "hold"`: keep the end values outside the data's range.
    pub hold: bool,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The forms an index of refraction can be written in.
#[derive(Debug, Clone, PartialEq)]
pub enum IorKind {
    /// The same index at every wavelength.
    Constant(f64),
    /// A glass of the catalogue, by name.
    Glass(String),
    /// n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), λ in µm.
    Sellmeier {
        /// Strengths.
        b: Vec<f64>,
        /// Poles, µm².
        c_um2: Vec<f64>,
    },
    /// n = A + B/λ² + C/λ⁴ + …, λ in µm.
    Cauchy(Vec<f64>),
    /// Index at the d line and Abbe number.
    Abbe {
        /// n at 587.5618 nm.
        nd: f64,
        /// Abbe number (n_d − 1) / (n_F − n_C).
        vd: f64,
    },
    /// Piecewise linear.
    Tabulated {
        /// Wavelengths, nm, strictly ascending.
        wavelengths_nm: Vec<f64>,
        /// Indices there.
        values: Vec<f64>,
    },
    /// A refractiveindex.info YAML file, relative to the scene file.
    File(PathBuf),
}

/// A material.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialDescription {
    /// What kind, with its parameters.
    pub kind: MaterialKind,
    /// Whether the back side scatters like the front; true by default where it applies.
    pub two_sided: bool,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The kinds of material.
#[derive(Debug, Clone, PartialEq)]
pub enum MaterialKind {
    /// Lambertian reflection.
    Diffuse {
        /// Reflectance in [0, 1].
        reflectance: SpectrumDescription,
    },
    /// Perfect mirror.
    Mirror {
        /// Reflectance in [0, 1].
        reflectance: SpectrumDescription,
    },
    /// Metal.
    Conductor {
        /// Its complex index.
        index: ConductorDescription,
        /// GGX α in [0, 1]; 0 is smooth.
        roughness: f64,
    },
    /// Transparent solid.
    Dielectric {
        /// Index of refraction, relative to air.
        ior: IorDescription,
        /// GGX α in [0, 1]; 0 is smooth.
        roughness: f64,
        /// Absorption inside, per metre.
        absorption_per_m: Option<SpectrumDescription>,
        /// The higher wins where volumes overlap.
        priority: i32,
    },
}

/// The complex index of a metal.
#[derive(Debug, Clone, PartialEq)]
pub enum ConductorDescription {
    /// A metal of data/metals by name.
    Metal(String),
    /// Given spectra.
    EtaK {
        /// Real part.
        eta: SpectrumDescription,
        /// Imaginary part.
        k: SpectrumDescription,
    },
}

/// A shape in the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectDescription {
    /// Name for messages.
    pub name: Option<String>,
    /// The shape in its own coordinates.
    pub shape: ShapeDescription,
    /// Applied in order.
    pub transform: Vec<TransformStep>,
    /// Index into `SceneDescription::materials`; without one the surface is black.
    pub material: Option<usize>,
    /// Emitted radiance.
    pub emission: Option<SpectrumDescription>,
    /// Whether the back side emits as well.
    pub emission_two_sided: bool,
    /// Its place in the file.
    pub at: JsonPath,
}

/// One step of an object's transform.
#[derive(Debug, Clone, PartialEq)]
pub enum TransformStep {
    /// Shift, metres.
    Translate([f64; 3]),
    /// Rotation about an axis through the origin, right-handed.
    Rotate {
        /// Angle, degrees.
        degrees: f64,
        /// Axis, not zero.
        axis: [f64; 3],
    },
    /// Factors along x, y, z.
    Scale([f64; 3]),
    /// An affine matrix in row-major order; its last row is 0 0 0 1.
    Matrix([f64; 16]),
}

/// The shapes.
#[derive(Debug, Clone, PartialEq)]
pub enum ShapeDescription {
    /// A sphere.
    Sphere {
        /// Centre, metres.
        center: [f64; 3],
        /// Radius, metres, > 0.
        radius: f64,
    },
    /// A parallelogram with normal u × v.
    Quad {
        /// A corner.
        origin: [f64; 3],
        /// First edge.
        u: [f64; 3],
        /// Second edge.
        v: [f64; 3],
    },
    /// A flat disk.
    Disk {
        /// Centre.
        center: [f64; 3],
        /// Normal, not zero.
        normal: [f64; 3],
        /// Radius, > 0.
        radius: f64,
    },
    /// A box with edges along the axes.
    Box {
        /// Smallest corner, metres.
        min: [f64; 3],
        /// Largest corner, metres.
        max: [f64; 3],
    },
    /// A cylinder: axis y, centred.
    Cylinder {
        /// Radius, metres, > 0.
        radius: f64,
        /// Height, metres, > 0.
        height: f64,
        /// Whether it is without caps.
        open: bool,
    },
    /// Triangles given in the file.
    Triangles {
        /// Vertices.
        positions: Vec<[f64; 3]>,
        /// Vertex triples, in range.
        indices: Vec<[u32; 3]>,
        /// One a vertex, or empty.
        normals: Vec<[f64; 3]>,
        /// One a vertex, or empty.
        uvs: Vec<[f64; 2]>,
    },
    /// Triangles from an .obj or .ply file, relative to the scene file.
    Mesh {
        /// The file.
        file: PathBuf,
    },
    /// A surface given by an equation.
    Implicit(ImplicitDescription),
    /// An isosceles prism along y, centred, apex towards +x.
    Prism {
        /// Angle at the apex, degrees in (0, 180).
        apex_degrees: f64,
        /// Length of the two equal sides, metres.
        side: f64,
        /// Length along y, metres.
        length: f64,
    },
    /// A round brilliant: axis y, table up, girdle plane y = 0.
    Brilliant(BrilliantDescription),
    /// A spherical lens: axis z, centred, radii positive when convex.
    Lens {
        /// Radii of curvature of the faces towards −z and +z, metres; infinite (written as null) for a flat face.
        radii: [f64; 2],
        /// Thickness at the centre, metres.
        thickness: f64,
        /// Diameter, metres.
        diameter: f64,
    },
}

/// Cut of a round brilliant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrilliantDescription {
    /// Girdle radius, metres.
    pub radius: f64,
    /// Table diameter as a fraction of the girdle's; 0.57 by default.
    pub table: f64,
    /// Angle of the crown mains to the girdle plane, degrees; 34.5 by default.
    pub crown_degrees: f64,
    /// Angle of the pavilion mains, degrees; 40.75 by default.
    pub pavilion_degrees: f64,
    /// Girdle thickness as a fraction of its diameter; 0.03 by default.
    pub girdle: f64,
    /// Star facet length: share of the way from table to girdle, in (0, 1); 0.5 by default.
    pub star: f64,
    /// Lower-half facet length: share of the way from girdle to culet, in (0, 1); 0.77 by default.
    pub lower_half: f64,
}

/// Built-in implicit surfaces; closed solids, outward normals.
#[derive(Debug, Clone, PartialEq)]
pub enum ImplicitDescription {
    /// Torus about the y axis.
    Torus {
        /// Centre line radius.
        major_radius: f64,
        /// Tube radius, < major_radius.
        minor_radius: f64,
    },
    /// (|x/a|^(2/e₂) + |z/c|^(2/e₂))^(e₂/e₁) + |y/b|^(2/e₁) = 1.
    Superquadric {
        /// Half axes a, b, c, metres.
        radii: [f64; 3],
        /// e₁: north–south, in [0.1, 2]; 1 is round, small is boxy, 2 is octahedral.
        exponent_y: f64,
        /// e₂: east–west, in [0.1, 2].
        exponent_xz: f64,
    },
    /// A gyroid wall of the given thickness, cut by a sphere about the origin.
    Gyroid {
        /// Period of the surface, metres.
        period: f64,
        /// Wall thickness, metres (to first order, where the gradient is largest and the wall thinnest), < period / 4.
        thickness: f64,
        /// Radius of the sphere that cuts it, metres, ≤ 100 periods.
        radius: f64,
    },
    /// Spheres melted into each other.
    SmoothUnion {
        /// Centres.
        centers: Vec<[f64; 3]>,
        /// Radii, one a centre.
        radii: Vec<f64>,
        /// Width of the blend, metres, ≥ 0.
        blend: f64,
    },
    /// A quartic "tangle cube": x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + level = 0 in units of `size`.
    Tanglecube {
        /// Length of one unit, metres.
        size: f64,
        /// The constant term, in [−100, 18.75); 11.8 by default.
        level: f64,
    },
}

/// A light without a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct LightDescription {
    /// The kind with its parameters.
    pub kind: LightKind,
    /// Name for messages.
    pub name: Option<String>,
    /// Its place in the file.
    pub at: JsonPath,
}

/// The kinds of light without a shape.
#[derive(Debug, Clone, PartialEq)]
pub enum LightKind {
    /// Equal intensity in every direction.
    Point {
        /// Position, metres.
        position: [f64; 3],
        /// W·sr⁻¹·nm⁻¹.
        intensity: SpectrumDescription,
    },
    /// A cone with a smooth edge.
    Spot {
        /// Position, metres.
        position: [f64; 3],
        /// Axis.
        direction: [f64; 3],
        /// On the axis, W·sr⁻¹·nm⁻¹.
        intensity: SpectrumDescription,
        /// Half angle of full intensity, degrees.
        inner_degrees: f64,
        /// Half angle where it ends, degrees.
        outer_degrees: f64,
    },
    /// Parallel light from infinitely far away, or from a disc like the sun's.
    Directional {
        /// Direction of travel.
        direction: [f64; 3],
        /// On a plane facing it, W·m⁻²·nm⁻¹.
        irradiance: SpectrumDescription,
        /// Full angle of the disc; 0 for exactly parallel light.
        angular_diameter_degrees: f64,
    },
    /// A collimated beam of circular section.
    Beam {
        /// Centre of the disc it starts from, metres.
        origin: [f64; 3],
        /// Direction of travel.
        direction: [f64; 3],
        /// Radius, metres.
        radius: f64,
        /// W·nm⁻¹.
        power: SpectrumDescription,
    },
}

/// Light from infinitely far away, the same from every direction.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentDescription {
    /// Radiance.
    pub radiance: SpectrumDescription,
    /// Its place in the file.
    pub at: JsonPath,
}

/// How the film is developed for PNG.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DevelopDescription {
    /// Exposure in stops; `None` is automatic.
    pub exposure_ev: Option<f64>,
    /// Tone mapping operator.
    pub tonemap: Tonemap,
}

/// Tone mapping operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tonemap {
    /// None: linear up to 1, clipped above.
    Srgb,
    /// 1 − exp(−x) on each channel.
    Exponential,
    /// Reinhard's global operator on luminance.
    Reinhard,
}
