//! Reads IES TM-27 `.spdx` files, which are XML \[TM27\].

use super::{Format, NamedSpectrum, Quantity, Samples, SpectrumFile, at_line, number};
use crate::spectrum::PiecewiseLinear;
use crate::{Error, ErrorKind, Result};
use roxmltree::{Document, Node};

/// IES TM-27, which is XML.
pub(super) const FORMAT: Format = Format { extensions: &["spdx", "xml"], parse };

fn parse(text: &str) -> Result<SpectrumFile> {
    let document = Document::parse(text)
        .map_err(|e| at_line(e.pos().row as usize)(Error::new(ErrorKind::Syntax, format!("not XML: {e}"))))?;
    let name = text_of(document.root(), "Description").unwrap_or_default();
    let quantity = text_of(document.root(), "SpectralQuantity").and_then(Quantity::from_word);
    let mut distributions: Vec<Node> =
        document.descendants().filter(|node| node.tag_name().name() == "SpectralDistribution").collect();
    if distributions.is_empty() {
        distributions.push(document.root());
    }
    let count = distributions.len();
    let spectra = distributions.into_iter().enumerate().map(|(i, node)| {
        let name = if count == 1 { name.to_owned() } else { format!("distribution {}", i + 1) };
        Ok(NamedSpectrum { name, table: distribution(&document, node)? })
    });
    Ok(SpectrumFile { spectra: spectra.collect::<Result<_>>()?, quantity })
}

/// Returns the trimmed text of the first element of a name, if it has any.
fn text_of<'a>(root: Node<'a, '_>, element: &str) -> Option<&'a str> {
    let node = root.descendants().find(|node| node.tag_name().name() == element)?;
    node.text().map(str::trim).filter(|text| !text.is_empty())
}

fn distribution(document: &Document, node: Node) -> Result<PiecewiseLinear> {
    let mut samples = Samples::default();
    for node in node.descendants().filter(|node| node.tag_name().name() == "SpectralData") {
        // The line is looked up only when something is wrong: finding it reads the text from its start.
        sample(node)
            .and_then(|(lambda, value)| samples.push(lambda, value))
            .map_err(|error| at_line(document.text_pos_at(node.range().start).row as usize)(error))?;
    }
    samples.finish()
}

fn sample(node: Node) -> Result<(f64, f64)> {
    let Some(lambda) = node.attribute("wavelength") else {
        let message = "SpectralData without a wavelength; expected the attribute \"wavelength\" in nm";
        return Err(Error::new(ErrorKind::Missing, message));
    };
    Ok((number(lambda.trim())?, number(node.text().unwrap_or_default().trim())?))
}
