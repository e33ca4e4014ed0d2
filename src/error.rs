//! The one error type: few kinds, each with its place and what was expected there.

use std::fmt;
use std::path::{Path, PathBuf};

/// Shorthand for results of this crate.
pub type Result<T> = std::result::Result<T, Error>;

/// What went wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// Arguments that make no sense, or leave open what is meant.
    Usage,
    /// Text that is not JSON, YAML, CSV, … at all.
    Syntax,
    /// A key that this object does not have.
    UnknownKey,
    /// A value of another type than expected.
    WrongType,
    /// A number outside its range.
    OutOfRange,
    /// NaN or infinity.
    NotFinite,
    /// A name that does not resolve.
    UnknownName,
    /// A required key or value that is absent.
    Missing,
    /// A key or name given twice.
    Duplicate,
    /// Geometry without extent, or a singular transform.
    Degenerate,
    /// A reference that leads nowhere or back to itself.
    BadReference,
    /// A file that does not exist or cannot be opened.
    FileNotFound,
    /// A file whose content is not what its format demands.
    FileFormat,
    /// A size or number above the documented limit.
    LimitExceeded,
    /// A value that is understood, but not supported.
    Unsupported,
    /// A scene of another format version.
    Version,
    /// Writing or reading failed for a reason of the system's.
    Io,
}

impl ErrorKind {
    /// Stable name in snake case, for programs.
    pub fn code(self) -> &'static str {
        use ErrorKind::*;
        match self {
            Usage => "bad_flag",
            Syntax => "syntax",
            UnknownKey => "unknown_key",
            WrongType => "wrong_type",
            OutOfRange => "out_of_range",
            NotFinite => "not_finite",
            UnknownName => "unknown_name",
            Missing => "missing",
            Duplicate => "duplicate",
            Degenerate => "degenerate",
            BadReference => "bad_reference",
            FileNotFound => "file_not_found",
            FileFormat => "file_format",
            LimitExceeded => "limit_exceeded",
            Unsupported => "unsupported",
            Version => "version",
            Io => "io",
        }
    }
}

/// An error for people: what, where, what was expected, the nearest valid name.
///
/// ```
/// use abbe::{Error, ErrorKind};
/// let error = Error::new(ErrorKind::UnknownName, "unknown glass \"N-SF12\"")
///     .at("materials.glass.ior.glass")
///     .in_file("scenes/x.json")
///     .nearest("N-SF12", ["N-BK7", "N-SF11"]);
/// assert_eq!(
///     error.to_string(),
///     "scenes/x.json: materials.glass.ior.glass: unknown glass \"N-SF12\"; did you mean \"N-SF11\"?"
/// );
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Error {
    /// What went wrong.
    pub kind: ErrorKind,
    /// The file it is in, if any.
    pub file: Option<PathBuf>,
    /// JSON path (`objects[2].shape.radius`) or line (`line 12`) inside the file; may be empty.
    pub place: String,
    /// What was found and what was expected; one line.
    pub message: String,
    /// The valid name nearest to the one given.
    pub nearest: Option<String>,
}

impl Error {
    /// An error without a place yet.
    pub fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        Self { kind, file: None, place: String::new(), message: message.into(), nearest: None }
    }

    /// Sets the place, unless a place further inside is already known.
    pub fn at(mut self, place: impl Into<String>) -> Self {
        if self.place.is_empty() {
            self.place = place.into();
        }
        self
    }

    /// Sets the file, unless one is already known.
    pub fn in_file(mut self, file: impl AsRef<Path>) -> Self {
        self.file.get_or_insert_with(|| file.as_ref().to_owned());
        self
    }

    /// A name that is none of `known`: the message lists these and suggests the nearest.
    pub fn unknown_name<'a>(what: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> Self {
        let known: Vec<&str> = known.into_iter().collect();
        Self::unknown_name_of(what, name, &format!("one of {}", known.join(", ")), known)
    }

    /// As [`Self::unknown_name`], for lists too long to be told: `expected` describes what is in them.
    pub fn unknown_name_of<'a>(
        what: &str,
        name: &str,
        expected: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let message = format!("unknown {what} {name:?}; expected {expected}");
        Self::new(ErrorKind::UnknownName, message).nearest(name, known)
    }

    /// Adds the candidate that looks most like `name`, if any looks like it at all.
    pub fn nearest<'a>(mut self, name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Self {
        self.nearest = nearest_name(name, candidates).map(str::to_owned);
        self
    }
}

/// Names by which other programs know things, each with abbe's.
const ELSEWHERE: [(&str, &str); 16] = [
    ("ball", "sphere"),
    ("cube", "box"),
    ("eye", "from"),
    ("fov", "fov_degrees"),
    ("glass", "dielectric"),
    ("lambertian", "diffuse"),
    ("look_at", "to"),
    ("matte", "diffuse"),
    ("metal", "conductor"),
    ("obj", "mesh"),
    ("origin", "from"),
    ("plane", "quad"),
    ("ply", "mesh"),
    ("rectangle", "quad"),
    ("spp", "samples_per_pixel"),
    ("sun", "directional"),
];

/// Returns the candidate that is meant by `name` in other programs, or else the one most similar to it (case ignored);
/// `None` when nothing is similar.
pub fn nearest_name<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    let candidates: Vec<&str> = candidates.into_iter().collect();
    let here = ELSEWHERE.iter().find(|(elsewhere, _)| *elsewhere == lower).map(|(_, here)| here);
    if let Some(candidate) = candidates.iter().find(|candidate| Some(*candidate) == here) {
        return Some(candidate);
    }
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&lower, &candidate.to_lowercase()), candidate))
        .filter(|(similarity, _)| *similarity > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}: ", file.display())?;
        }
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        f.write_str(&self.message)?;
        match &self.nearest {
            Some(name) => write!(f, "; did you mean \"{name}\"?"),
            None => Ok(()),
        }
    }
}

/// Prints as [`Display`](fmt::Display) does: a `main` that returns a [`crate::Result`] shows its error by this.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl std::error::Error for Error {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_programs_are_understood() {
        let shapes = ["sphere", "triangles", "quad", "box"];
        assert_eq!(nearest_name("Rectangle", shapes), Some("quad"));
        assert_eq!(nearest_name("plane", shapes), Some("quad"));
        assert_eq!(nearest_name("triangle", shapes), Some("triangles"));
        assert_eq!(nearest_name("glass", ["diffuse", "dielectric"]), Some("dielectric"));
        assert_eq!(nearest_name("fov", ["fov_axis", "fov_degrees"]), Some("fov_degrees"));
        assert_eq!(
            nearest_name("metal", ["metal_name", "wood"]),
            Some("metal_name"),
            "abbe's name is no candidate here"
        );
    }

    #[test]
    fn a_main_that_fails_shows_the_message() {
        let error = Error::unknown_name("lamp", "FL12x", ["FL12", "D65"]);
        assert_eq!(format!("{error:?}"), error.to_string());
    }
}
