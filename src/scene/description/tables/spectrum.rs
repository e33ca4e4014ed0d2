//! Spectra and indices of refraction.

use super::kinds::*;

/// Most knots of one table.
pub const MAX_KNOTS: usize = 1_000_000;

/// Most coefficients of a dispersion formula.
const MAX_TERMS: usize = 16;

const WAVELENGTHS: Kind = Kind::Numbers(Numbers::several(1, MAX_KNOTS, Range::POSITIVE));
const WAVELENGTHS_DOC: &str = "Wavelengths in nanometres, strictly ascending.";
const COEFFICIENTS: Numbers = Numbers::several(1, MAX_TERMS, Range::ANY);

/// A spectrum, wherever one is wanted.
pub static SPECTRUM: Forms = Forms {
    what: "a spectrum",
    number: Some(("The same value at every wavelength.", Range::ANY)),
    text: Some("The name of one of `spectra`."),
    forms: &[&NAMED, &TABULATED, &FILE, &RGB, &ILLUMINANT, &BLACKBODY, &LINE],
};

/// Keys of every spectrum.
static COMMON: &[Field] =
    &[default("scale", Kind::Number(Range::NOT_NEGATIVE), "1", "A factor on the whole spectrum.")];

/// A spectrum object without rule or later keys.
const fn form(what: &'static str, doc: &'static str, fields: &'static [Field]) -> Table {
    Table { what, doc, fields, common: COMMON, rule: Rule::Free, later: &[] }
}

static NAMED_FIELDS: [Field; 1] = [required("name", Kind::Name("one of `spectra`"), "The name of one of `spectra`.")];
static NAMED: Table = form("a spectrum by name", "One of `spectra`.", &NAMED_FIELDS);

static TABULATED_FIELDS: [Field; 2] = [
    required("wavelengths_nm", WAVELENGTHS, WAVELENGTHS_DOC),
    required("values", Kind::Numbers(Numbers::several(1, MAX_KNOTS, Range::ANY)), "Values, one for each wavelength."),
];
static TABULATED: Table = form(
    "a tabulated spectrum",
    "Piecewise linear; constant beyond its ends, with a warning if they lie inside 400–700 nm.",
    &TABULATED_FIELDS,
);

static SPECTRUM_FILE: FileKind = FileKind { what: "a spectrum", extensions: &["csv", "spd", "spdx"], later: &[] };
static FILE_FIELDS: [Field; 1] =
    [required("file", Kind::File(&SPECTRUM_FILE), "Path of a table of wavelengths in nanometres and values.")];
static FILE: Table = form("a spectrum in a file", "Piecewise linear, read from a file.", &FILE_FIELDS);

static RGB_FIELDS: [Field; 2] = [
    required("rgb", Kind::Numbers(Numbers::exactly(3, Range::NOT_NEGATIVE)), "Linear components, white is [1, 1, 1]."),
    default("space", Kind::Name("an RGB colour space"), "\"srgb\"", "The RGB colour space of the components."),
];
static RGB: Table = form(
    "an RGB spectrum",
    "A colour, upsampled as a reflectance (white is exactly 1) or as an emission (white develops to RGB [1, 1, 1]), \
     according to where it stands; not for absorption, eta or k.",
    &RGB_FIELDS,
);

static ILLUMINANT_FIELDS: [Field; 1] =
    [required("illuminant", Kind::Name("an illuminant"), "Name of a table of the colour library, such as D65.")];
static ILLUMINANT: Table =
    form("an illuminant", "A standard illuminant, normalised to luminance Y = 1.", &ILLUMINANT_FIELDS);

static BLACKBODY_FIELDS: [Field; 2] = [
    required("blackbody_kelvin", Kind::Number(Range { above: true, ..Range::from_to(0.0, 1e9) }), "Temperature, K."),
    default("normalize", Kind::Bool, "true", "Whether to scale to Y = 1; otherwise absolute Planck radiance."),
];
static BLACKBODY: Table = form("a black body", "Planck's law.", &BLACKBODY_FIELDS);

static LINE_FIELDS: [Field; 2] = [
    required("line_nm", Kind::Number(Range::POSITIVE), "Centre, nanometres."),
    required("fwhm_nm", Kind::Number(Range::POSITIVE), "Full width at half maximum, nanometres."),
];
static LINE: Table = form("a spectral line", "A Gaussian of unit area.", &LINE_FIELDS);

/// An index of refraction relative to air.
pub static IOR: Forms = Forms {
    what: "an index of refraction",
    number: Some(("The same index at every wavelength.", Range::POSITIVE)),
    text: None,
    forms: &[&GLASS, &SELLMEIER, &CAUCHY, &ABBE, &IOR_TABULATED, &IOR_FILE],
};

static HOLD: Choice = Choice {
    what: "a way to extrapolate",
    names: &[("hold", "Keep the index of the nearest end of the data's range.")],
    later: &[],
};

/// Keys of every index.
static IOR_COMMON: &[Field] = &[optional(
    "extrapolate",
    Kind::Choice(&HOLD),
    "What to do outside the data's range; without it a formula is continued by up to 100 nm, anything further is an error.",
)];

const fn ior(what: &'static str, doc: &'static str, fields: &'static [Field]) -> Table {
    Table { what, doc, fields, common: IOR_COMMON, rule: Rule::Free, later: &[] }
}

static GLASS_FIELDS: [Field; 1] =
    [required("glass", Kind::Name("a glass of the catalogue"), "Name in the catalogue, as `abbe glass` lists them.")];
static GLASS: Table = ior("a glass", "A glass of the catalogue.", &GLASS_FIELDS);

static SELLMEIER_TERMS: Table = Table {
    what: "a Sellmeier formula",
    doc: "The coefficients of a Sellmeier formula.",
    fields: &[
        required("b", Kind::Numbers(COEFFICIENTS), "Strengths."),
        required(
            "c_um2",
            Kind::Numbers(Numbers { item: Range::NOT_NEGATIVE, ..COEFFICIENTS }),
            "Poles in square micrometres, one for each strength.",
        ),
    ],
    common: &[],
    rule: Rule::Free,
    later: &[],
};
static SELLMEIER_FIELDS: [Field; 1] =
    [required("sellmeier", Kind::Object(&SELLMEIER_TERMS), "n² = 1 + Σ bᵢ λ² / (λ² − cᵢ), λ in micrometres.")];
static SELLMEIER: Table = ior("a Sellmeier formula", "A dispersion formula.", &SELLMEIER_FIELDS);

static CAUCHY_FIELDS: [Field; 1] =
    [required("cauchy_um", Kind::Numbers(COEFFICIENTS), "A, B, C, … of n = A + B/λ² + C/λ⁴ + …, λ in micrometres.")];
static CAUCHY: Table = ior("a Cauchy formula", "A dispersion formula.", &CAUCHY_FIELDS);

static ABBE_FIELDS: [Field; 2] = [
    required("nd", Kind::Number(Range { min: 1.0, ..Range::POSITIVE }), "Index at the d line, 587.5618 nm."),
    required("vd", Kind::Number(Range::POSITIVE), "Abbe number (n_d − 1) / (n_F − n_C)."),
];
static ABBE: Table = ior("an index by its Abbe number", "Cauchy's formula through n_d and V_d.", &ABBE_FIELDS);

static IOR_TABULATED_FIELDS: [Field; 2] = [
    required("wavelengths_nm", WAVELENGTHS, WAVELENGTHS_DOC),
    required("values", Kind::Numbers(Numbers::several(1, MAX_KNOTS, Range::POSITIVE)), "Indices, one for each."),
];
static IOR_TABULATED: Table = ior("a tabulated index", "Piecewise linear.", &IOR_TABULATED_FIELDS);

static IOR_DATA: FileKind =
    FileKind { what: "a refractiveindex.info record", extensions: &["yml", "yaml"], later: &[] };
static IOR_FILE_FIELDS: [Field; 1] =
    [required("file", Kind::File(&IOR_DATA), "Path of a refractiveindex.info record.")];
static IOR_FILE: Table = ior("an index in a file", "A record of refractiveindex.info.", &IOR_FILE_FIELDS);
