//! The file's named spectra: their references to each other, followed without recursion.

use super::codec::Value;
use super::context::{Context, Names};
use super::spectrum::{SpectrumDescription, SpectrumKind, extent_of, scaled};
use super::text::quote;
use crate::{Error, ErrorKind, Result};

/// Follows the references between named spectra, refuses cycles, and finds what each spans.
pub fn resolve(value: &Value, named: &[(String, SpectrumDescription)]) -> Result<()> {
    const UNSEEN: usize = usize::MAX;
    const DONE: usize = usize::MAX - 1;
    let Context { spectra, extents, .. } = value.context;
    *spectra.borrow_mut() = Names::new(named.iter().map(|(name, _)| name.clone()));
    let mut position = vec![UNSEEN; named.len()];
    let mut extents = extents.borrow_mut();
    *extents = vec![None; named.len()];
    for start in 0..named.len() {
        let mut chain = Vec::new();
        let mut next = Some(start);
        while let Some(here) = next.filter(|&i| position[i] != DONE) {
            if position[here] != UNSEEN {
                return Err(cycle(named, &chain[position[here]..]));
            }
            position[here] = chain.len();
            chain.push(here);
            next = match &named[here].1.kind {
                SpectrumKind::Named(name) => {
                    Some(spectra.borrow_mut().find(name, "spectrum", "spectra", &named[here].1.at)?)
                }
                _ => None,
            };
        }
        let mut target = next;
        for &here in chain.iter().rev() {
            let spectrum = &named[here].1;
            extents[here] = match target {
                Some(target) => extents[target].as_ref().map(|extent| scaled(extent, spectrum.scale)),
                None => extent_of(spectrum),
            };
            position[here] = DONE;
            target = Some(here);
        }
    }
    Ok(())
}

fn cycle(named: &[(String, SpectrumDescription)], chain: &[usize]) -> Error {
    let names: Vec<String> = chain.iter().chain(&chain[..1]).take(9).map(|&i| quote(&named[i].0)).collect();
    let more = if chain.len() > 8 { " → …" } else { "" };
    let message = format!("the spectra refer to each other in a circle: {}{more}", names.join(" → "));
    Error::new(ErrorKind::BadReference, message).at(named[chain[0]].1.at.clone())
}
