//! Reads `.spd` files: wavelength and value in turn, with white space between.

use super::{Format, NamedSpectrum, Samples, SpectrumFile, at_line, content_lines, number};
use crate::{Error, ErrorKind, Result};

/// Numbers between white space, wavelength and value in turn.
pub(super) const FORMAT: Format = Format { extensions: &["spd"], parse };

fn parse(text: &str) -> Result<SpectrumFile> {
    let mut samples = Samples::default();
    let mut pending = None;
    let words =
        content_lines(text).flat_map(|(line, content)| content.split_whitespace().map(move |word| (line, word)));
    for (line, word) in words {
        let value = number(word).map_err(at_line(line))?;
        pending = match pending {
            None => Some((line, value)),
            Some((_, lambda)) => {
                samples.push(lambda, value).map_err(at_line(line))?;
                None
            }
        };
    }
    if let Some((line, lambda)) = pending {
        let message = format!("wavelength {lambda} without a value; expected pairs of wavelength and value");
        return Err(at_line(line)(Error::new(ErrorKind::FileFormat, message)));
    }
    let spectrum = NamedSpectrum { name: String::new(), table: samples.finish()? };
    Ok(SpectrumFile { spectra: vec![spectrum], quantity: None })
}
