//! Spectra and indices of refraction: tables of wavelengths, references by name, ranges that depend on the role.

use std::collections::HashMap;
use std::path::PathBuf;

use super::fields::Fields;
use super::json::{Json, quote, show};
use super::path::Path;
use super::tables::*;
use super::types::*;
use super::validate::{error, with_nearest};
use crate::{Error, ErrorKind, Result};

/// Most knots of all tables of a file together.
const MAX_TOTAL_KNOTS: usize = 10_000_000;

/// Peak of a Gaussian of unit area and unit full width at half maximum: 2 √(ln 2 / π).
const GAUSSIAN_PEAK: f64 = 0.939_437_278_699_651_3;

/// What the values of a spectrum span, as far as that is known without reading files.
#[derive(Debug, Clone)]
struct Extent {
    low: f64,
    high: f64,
    low_at: JsonPath,
    high_at: JsonPath,
    is_rgb: bool,
}

/// The named spectra and what decoding spectra needs to know.
pub struct Spectra {
    /// Folder of the scene file.
    folder: PathBuf,
    /// The named spectra, in file order.
    pub named: Vec<(String, SpectrumDescription)>,
    index: HashMap<String, usize>,
    extents: Vec<Option<Extent>>,
    used: Vec<bool>,
    knots: usize,
    /// What deserves a look but is no error.
    pub warnings: Vec<String>,
}

impl Spectra {
    /// Decodes the file's `spectra` and follows their references.
    pub fn decode(folder: PathBuf, json: &Json, path: &Path) -> Result<Self> {
        let mut this = Self {
            folder,
            named: Vec::new(),
            index: HashMap::new(),
            extents: Vec::new(),
            used: Vec::new(),
            knots: 0,
            warnings: Vec::new(),
        };
        for (name, value) in super::fields::named(json) {
            let spectrum = this.read(value, &Path::Key(path, name))?;
            this.index.insert(name.clone(), this.named.len());
            this.named.push((name.clone(), spectrum));
        }
        this.used = vec![false; this.named.len()];
        this.resolve()?;
        Ok(this)
    }

    /// Names of the spectra that nothing refers to.
    pub fn unused(&self) -> impl Iterator<Item = &str> {
        self.named.iter().zip(&self.used).filter(|(_, used)| !**used).map(|((name, _), _)| name.as_str())
    }

    /// A path of the file, relative to the scene's folder.
    pub fn file(&self, fields: &Fields) -> PathBuf {
        self.folder.join(fields.text("file"))
    }

    /// Decodes a spectrum that stands in a role, and checks that its values suit it.
    pub fn spectrum(&mut self, role: Role, json: &Json, path: &Path) -> Result<SpectrumDescription> {
        let spectrum = self.read(json, path)?;
        let extent = match &spectrum.kind {
            SpectrumKind::Named(name) => {
                let index = self.find(name, &spectrum.at)?;
                self.used[index] = true;
                self.extents[index].as_ref().map(|extent| scaled(extent.clone(), spectrum.scale))
            }
            _ => extent_of(&spectrum),
        };
        match extent {
            Some(extent) => check_role(role, &spectrum, &extent).map(|()| spectrum),
            None => Ok(spectrum),
        }
    }

    /// Decodes a spectrum whose role is not known.
    fn read(&mut self, json: &Json, path: &Path) -> Result<SpectrumDescription> {
        let at = path.to_string();
        let (kind, scale) = match json {
            Json::Text(name) => (SpectrumKind::Named(name.clone()), 1.0),
            Json::Object(_) => {
                let (form, fields) = Fields::form(&SPECTRUM, json, path)?;
                (self.form(form, &fields)?, fields.number("scale"))
            }
            number => (SpectrumKind::Constant(number.as_number().expect("checked to be a number")), 1.0),
        };
        Ok(SpectrumDescription { kind, scale, at })
    }

    fn form(&mut self, form: &str, fields: &Fields) -> Result<SpectrumKind> {
        Ok(match form {
            "name" => SpectrumKind::Named(fields.text("name")),
            "wavelengths_nm" => {
                let (wavelengths_nm, values) = self.table(fields)?;
                self.warn_of_ends(&wavelengths_nm, fields.path());
                SpectrumKind::Tabulated { wavelengths_nm, values }
            }
            "file" => SpectrumKind::File(self.file(fields)),
            "rgb" => SpectrumKind::Rgb { rgb: fields.array("rgb"), space: fields.text("space") },
            "illuminant" => SpectrumKind::Illuminant(fields.text("illuminant")),
            "blackbody_kelvin" => SpectrumKind::Blackbody {
                kelvin: fields.number("blackbody_kelvin"),
                normalize: fields.flag("normalize"),
            },
            "line_nm" => {
                let (line_nm, fwhm_nm) = (fields.number("line_nm"), fields.number("fwhm_nm"));
                check_unit(line_nm, &fields.at("line_nm"))?;
                SpectrumKind::Line { line_nm, fwhm_nm }
            }
            other => unreachable!("the table has no spectrum form {other}"),
        })
    }

    /// Wavelengths and values of a table.
    fn table(&mut self, fields: &Fields) -> Result<(Vec<f64>, Vec<f64>)> {
        let (wavelengths, values) = (fields.numbers("wavelengths_nm"), fields.numbers("values"));
        let path = fields.at("wavelengths_nm");
        if wavelengths.len() != values.len() {
            let message = format!("{} values for {} wavelengths; expected as many", values.len(), wavelengths.len());
            return Err(error(ErrorKind::WrongType, &fields.at("values"), message));
        }
        self.knots += values.len();
        if self.knots > MAX_TOTAL_KNOTS {
            let message = format!("the file's tables have more than {MAX_TOTAL_KNOTS} values, the limit");
            return Err(error(ErrorKind::LimitExceeded, &path, message));
        }
        if let Some(i) = wavelengths.windows(2).position(|pair| pair[1] <= pair[0]) {
            let message = format!(
                "wavelengths must ascend strictly; found {} after {}",
                show(wavelengths[i + 1]),
                show(wavelengths[i])
            );
            return Err(error(ErrorKind::OutOfRange, &Path::Index(&path, i + 1), message));
        }
        check_unit(wavelengths[wavelengths.len() - 1], &path)?;
        Ok((wavelengths, values))
    }

    /// Beyond its ends a table is constant, which is a guess where the eye sees well.
    fn warn_of_ends(&mut self, wavelengths_nm: &[f64], path: &Path) {
        let (first, last) = (wavelengths_nm[0], wavelengths_nm[wavelengths_nm.len() - 1]);
        if first > 400.0 || last < 700.0 {
            let (first, last) = (show(first), show(last));
            self.warnings.push(format!(
                "{path}: the table covers {first}–{last} nm; beyond its ends, inside 400–700 nm, it is held constant"
            ));
        }
    }

    /// Decodes an index of refraction.
    pub fn ior(&mut self, json: &Json, path: &Path) -> Result<IorDescription> {
        let at = path.to_string();
        if let Some(index) = json.as_number() {
            return Ok(IorDescription { kind: IorKind::Constant(index), hold: false, at });
        }
        let (form, fields) = Fields::form(&IOR, json, path)?;
        let kind = match form {
            "glass" => IorKind::Glass(fields.text("glass")),
            "sellmeier" => sellmeier(json.get("sellmeier").unwrap_or(&Json::Null), &fields.at("sellmeier"))?,
            "cauchy_um" => IorKind::Cauchy(fields.numbers("cauchy_um")),
            "nd" => IorKind::Abbe { nd: fields.number("nd"), vd: fields.number("vd") },
            "wavelengths_nm" => {
                let (wavelengths_nm, values) = self.table(&fields)?;
                IorKind::Tabulated { wavelengths_nm, values }
            }
            "file" => IorKind::File(self.file(&fields)),
            other => unreachable!("the table has no index form {other}"),
        };
        Ok(IorDescription { kind, hold: fields.given("extrapolate").is_some(), at })
    }

    fn find(&self, name: &str, at: &str) -> Result<usize> {
        self.index.get(name).copied().ok_or_else(|| {
            let message = match self.named.is_empty() {
                true => format!("no spectrum named {}; the file has no `spectra`", quote(name)),
                false => format!("no spectrum named {}; expected one of `spectra`", quote(name)),
            };
            let names = self.named.iter().map(|(name, _)| name.as_str());
            with_nearest(Error::new(ErrorKind::UnknownName, message).at(at), name, names)
        })
    }

    /// Follows the references between named spectra, refusing cycles, and finds what each spans.
    fn resolve(&mut self) -> Result<()> {
        const UNSEEN: usize = usize::MAX;
        const DONE: usize = usize::MAX - 1;
        let mut position = vec![UNSEEN; self.named.len()];
        self.extents = vec![None; self.named.len()];
        for start in 0..self.named.len() {
            let mut chain = Vec::new();
            let mut next = Some(start);
            while let Some(here) = next.filter(|&i| position[i] != DONE) {
                if position[here] != UNSEEN {
                    return Err(self.cycle(&chain[position[here]..]));
                }
                position[here] = chain.len();
                chain.push(here);
                next = match &self.named[here].1.kind {
                    SpectrumKind::Named(name) => Some(self.find(name, &self.named[here].1.at)?),
                    _ => None,
                };
            }
            let mut target = next;
            for &here in chain.iter().rev() {
                let spectrum = &self.named[here].1;
                self.extents[here] = match target {
                    Some(target) => self.extents[target].clone().map(|extent| scaled(extent, spectrum.scale)),
                    None => extent_of(spectrum),
                };
                if let Some(target) = target {
                    self.used[target] = true;
                }
                position[here] = DONE;
                target = Some(here);
            }
        }
        Ok(())
    }

    fn cycle(&self, chain: &[usize]) -> Error {
        let names: Vec<String> = chain.iter().chain(&chain[..1]).take(9).map(|&i| quote(&self.named[i].0)).collect();
        let more = if chain.len() > 8 { " → …" } else { "" };
        let message = format!("the spectra refer to each other in a circle: {}{more}", names.join(" → "));
        Error::new(ErrorKind::BadReference, message).at(self.named[chain[0]].1.at.clone())
    }
}

fn sellmeier(json: &Json, path: &Path) -> Result<IorKind> {
    let Some(Field { kind: Kind::Object(table), .. }) = IOR.owner("sellmeier").and_then(|form| form.fields.first())
    else {
        unreachable!("`sellmeier` is an object");
    };
    let fields = Fields::new(table, json, path);
    let (b, c_um2) = (fields.numbers("b"), fields.numbers("c_um2"));
    if b.len() != c_um2.len() {
        let message = format!("{} poles for {} strengths; expected as many", c_um2.len(), b.len());
        return Err(error(ErrorKind::WrongType, &fields.at("c_um2"), message));
    }
    Ok(IorKind::Sellmeier { b, c_um2 })
}

/// Refuses wavelengths that are plainly not in nanometres.
fn check_unit(largest: f64, path: &Path) -> Result<()> {
    let (unit, factor) = match largest {
        x if x < 1e-3 => ("metres", 1e9),
        x if x < 20.0 => ("micrometres", 1e3),
        _ => return Ok(()),
    };
    let nanometres = (largest * factor * 1e3).round() / 1e3;
    let message =
        format!("expected nanometres, found {}, which looks like {unit} ({} nm)", show(largest), show(nanometres));
    Err(error(ErrorKind::OutOfRange, path, message))
}

fn scaled(extent: Extent, scale: f64) -> Extent {
    Extent { low: extent.low * scale, high: extent.high * scale, ..extent }
}

/// What a spectrum spans, if it can be told from its own description.
fn extent_of(spectrum: &SpectrumDescription) -> Option<Extent> {
    let at = &spectrum.at;
    let span = |values: &[f64], key: &str| {
        let place = |i: usize| format!("{at}{key}[{i}]");
        let by_value = |&(_, a): &(usize, &f64), &(_, b): &(usize, &f64)| a.total_cmp(b);
        let (low_index, low) = values.iter().enumerate().min_by(by_value)?;
        let (high_index, high) = values.iter().enumerate().max_by(by_value)?;
        let (low_at, high_at) = (place(low_index), place(high_index));
        Some(Extent { low: *low, high: *high, low_at, high_at, is_rgb: false })
    };
    let flat = |low: f64, high: f64| Extent { low, high, low_at: at.clone(), high_at: at.clone(), is_rgb: false };
    let extent = match &spectrum.kind {
        SpectrumKind::Constant(value) => flat(*value, *value),
        SpectrumKind::Tabulated { values, .. } => span(values, ".values")?,
        SpectrumKind::Rgb { rgb, .. } => Extent { is_rgb: true, ..span(rgb, ".rgb")? },
        SpectrumKind::Line { fwhm_nm, .. } => flat(0.0, GAUSSIAN_PEAK / fwhm_nm),
        SpectrumKind::Named(_)
        | SpectrumKind::File(_)
        | SpectrumKind::Illuminant(_)
        | SpectrumKind::Blackbody { .. } => return None,
    };
    Some(scaled(extent, spectrum.scale))
}

fn check_role(role: Role, spectrum: &SpectrumDescription, extent: &Extent) -> Result<()> {
    let what = role.what();
    if extent.is_rgb && !role.takes_rgb() {
        let message = format!("{what} cannot be an RGB colour; expected a spectrum in its own unit");
        return Err(Error::new(ErrorKind::WrongType, message).at(spectrum.at.clone()));
    }
    let range = role.range();
    let (value, value_at) = match (range.contains(extent.low), range.contains(extent.high)) {
        (true, true) => return Ok(()),
        (false, _) => (extent.low, &extent.low_at),
        (_, false) => (extent.high, &extent.high_at),
    };
    let by_name = match &spectrum.kind {
        SpectrumKind::Named(name) => format!(" (spectrum {}, {value_at})", quote(name)),
        _ => String::new(),
    };
    let place = if by_name.is_empty() { value_at } else { &spectrum.at };
    let message = format!("expected {what}, a number{}, found {}{by_name}", range.describe(), show(value));
    Err(Error::new(ErrorKind::OutOfRange, message).at(place.clone()))
}
