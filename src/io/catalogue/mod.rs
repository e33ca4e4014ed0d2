//! The glasses and metals that come with abbe, by name.
//!
//! The data are refractiveindex.info files in `data/glass` and `data/metals`, embedded in the program; each folder has an
//! index with names, aliases, ranges and sources. Only the entry that is asked for is parsed.

use std::sync::LazyLock;

use super::refractive_index_info::{self, OpticalConstants};
use crate::optics::ior::IndexOfRefraction;
use crate::optics::table::Table;
use crate::{Error, ErrorKind, Result};

/// A row of the glass index.
#[derive(Debug, Clone, PartialEq)]
pub struct GlassEntry {
    /// Name in the catalogue.
    pub name: &'static str,
    /// Further names for the same entry.
    pub aliases: Vec<&'static str>,
    /// Page in refractiveindex.info: shelf/book/page.
    pub page: &'static str,
    /// Range of the data, nm.
    pub range_nm: [f64; 2],
    /// Index at the d line, as another program computes it from the same data.
    pub n_d: f64,
    /// Abbe number V_d, as another program computes it from the same data.
    pub v_d: f64,
    /// Author and year, or the maker.
    pub source: &'static str,
    /// Description of the material.
    pub description: &'static str,
    yaml: &'static str,
}

/// A row of the metal index.
#[derive(Debug, Clone, PartialEq)]
pub struct MetalEntry {
    /// Name in the catalogue: the chemical symbol.
    pub name: &'static str,
    /// Further names for the same entry.
    pub aliases: Vec<&'static str>,
    /// Page in refractiveindex.info: shelf/book/page.
    pub page: &'static str,
    /// Range of the data, nm.
    pub range_nm: [f64; 2],
    /// Real part of the index at 550 nm, as another program computes it from the same data.
    pub n_550: f64,
    /// Extinction coefficient at 550 nm, as another program computes it from the same data.
    pub k_550: f64,
    /// Author and year.
    pub source: &'static str,
    yaml: &'static str,
}

/// The complex index n + ik of a metal.
#[derive(Debug, Clone, PartialEq)]
pub struct Metal {
    /// Real part of the index, n.
    pub n: Table,
    /// Extinction coefficient, k.
    pub k: Table,
}

impl GlassEntry {
    /// Reads index, references and comments of the entry. The index is as published:
    /// [`IndexOfRefraction::checked`] settles what happens outside its range.
    ///
    /// # Errors
    /// None with the data as they come with abbe.
    pub fn constants(&self) -> Result<OpticalConstants> {
        refractive_index_info::parse(self.yaml).map_err(|e| e.in_file(format!("data/glass/{}.yml", self.name)))
    }
}

impl MetalEntry {
    /// Reads the measured n and k of the entry.
    ///
    /// # Errors
    /// None with the data as they come with abbe.
    pub fn complex_index(&self) -> Result<Metal> {
        let in_file = |e: Error| e.in_file(format!("data/metals/{}.yml", self.name));
        match refractive_index_info::parse(self.yaml).map_err(in_file)? {
            OpticalConstants { n: IndexOfRefraction::Table(n), k: Some(k), .. } => Ok(Metal { n, k }),
            _ => Err(in_file(Error::new(ErrorKind::FileFormat, "expected a table of n and k"))),
        }
    }
}

/// Lists all glasses in the order of the index.
///
/// # Errors
/// None with the data as they come with abbe.
pub fn glasses() -> Result<&'static [GlassEntry]> {
    static ENTRIES: LazyLock<Result<Vec<GlassEntry>>> = LazyLock::new(|| {
        rows(GLASS_INDEX, "data/glass/index.csv", 10).and_then(|rows| rows.iter().map(glass_entry).collect())
    });
    ENTRIES.as_deref().map_err(Error::clone)
}

/// Lists all metals in the order of the index.
///
/// # Errors
/// None with the data as they come with abbe.
pub fn metals() -> Result<&'static [MetalEntry]> {
    static ENTRIES: LazyLock<Result<Vec<MetalEntry>>> = LazyLock::new(|| {
        rows(METAL_INDEX, "data/metals/index.csv", 9).and_then(|rows| rows.iter().map(metal_entry).collect())
    });
    ENTRIES.as_deref().map_err(Error::clone)
}

/// Finds a glass by its name or an alias. Upper and lower case count as the same.
///
/// # Errors
/// `UnknownName` with the nearest name.
pub fn glass(name: &str) -> Result<&'static GlassEntry> {
    find(name, "glass", glasses()?, |entry| (entry.name, &entry.aliases))
}

/// Finds a metal by its name or an alias. Upper and lower case count as the same.
///
/// # Errors
/// `UnknownName` with the nearest name.
pub fn metal(name: &str) -> Result<&'static MetalEntry> {
    find(name, "metal", metals()?, |entry| (entry.name, &entry.aliases))
}

/// Lists the names of all glasses, without their aliases.
///
/// # Errors
/// None with the data as they come with abbe.
pub fn glass_names() -> Result<impl Iterator<Item = &'static str>> {
    Ok(glasses()?.iter().map(|entry| entry.name))
}

/// Lists the names of all metals, without their aliases.
///
/// # Errors
/// None with the data as they come with abbe.
pub fn metal_names() -> Result<impl Iterator<Item = &'static str>> {
    Ok(metals()?.iter().map(|entry| entry.name))
}

fn find<T>(
    name: &str,
    what: &str,
    entries: &'static [T],
    names: impl Fn(&'static T) -> (&'static str, &'static Vec<&'static str>),
) -> Result<&'static T> {
    let all = |entry| {
        let (name, aliases) = names(entry);
        std::iter::once(name).chain(aliases.iter().copied())
    };
    entries.iter().find(|&entry| all(entry).any(|known| known.eq_ignore_ascii_case(name))).ok_or_else(|| {
        let error = Error::new(ErrorKind::UnknownName, format!("unknown {what} \"{name}\""));
        error.nearest(name, entries.iter().flat_map(all))
    })
}

/// Cells of the rows of an index, without comments and column names, each with its line number.
fn rows(text: &'static str, file: &str, columns: usize) -> Result<Vec<(usize, Vec<&'static str>)>> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.starts_with('#') && !line.is_empty());
    lines
        .skip(1)
        .map(|(i, line)| {
            let cells: Vec<_> = line.split(',').collect();
            if cells.len() == columns {
                return Ok((i + 1, cells));
            }
            let message = format!("found {} cells, expected {columns}", cells.len());
            Err(Error::new(ErrorKind::FileFormat, message).at(format!("line {}", i + 1)).in_file(file))
        })
        .collect()
}

fn glass_entry((line, cells): &(usize, Vec<&'static str>)) -> Result<GlassEntry> {
    let number = |column: usize| cell_number(cells[column], *line, "data/glass/index.csv");
    Ok(GlassEntry {
        name: cells[0],
        aliases: aliases(cells[1]),
        page: cells[3],
        range_nm: [number(4)?, number(5)?],
        n_d: number(6)?,
        v_d: number(7)?,
        source: cells[8],
        description: cells[9],
        yaml: embedded(GLASS_FILES, cells[0])?,
    })
}

fn metal_entry((line, cells): &(usize, Vec<&'static str>)) -> Result<MetalEntry> {
    let number = |column: usize| cell_number(cells[column], *line, "data/metals/index.csv");
    Ok(MetalEntry {
        name: cells[0],
        aliases: aliases(cells[1]),
        page: cells[3],
        range_nm: [number(4)?, number(5)?],
        n_550: number(6)?,
        k_550: number(7)?,
        source: cells[8],
        yaml: embedded(METAL_FILES, cells[0])?,
    })
}

fn aliases(cell: &'static str) -> Vec<&'static str> {
    cell.split(';').filter(|alias| !alias.is_empty()).collect()
}

fn cell_number(cell: &str, line: usize, file: &str) -> Result<f64> {
    cell.parse().map_err(|_| {
        let message = format!("found \"{cell}\", expected a number");
        Error::new(ErrorKind::FileFormat, message).at(format!("line {line}")).in_file(file)
    })
}

fn embedded(files: &[(&'static str, &'static str)], name: &str) -> Result<&'static str> {
    files.iter().find(|(file, _)| *file == name).map(|(_, text)| *text).ok_or_else(|| {
        Error::new(ErrorKind::FileNotFound, format!("the index names \"{name}\", whose file is not embedded"))
    })
}

/// Pairs of name and text of the files `data/FOLDER/NAME.yml`.
macro_rules! files {
    ($folder:literal: $($name:literal)*) => {
        &[$(($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/data/", $folder, "/", $name, ".yml")))),*]
    };
}

const GLASS_INDEX: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/data/glass/index.csv"));
const METAL_INDEX: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/data/metals/index.csv"));

const GLASS_FILES: &[(&str, &str)] = files!("glass":
    "N-BK7" "N-BK10" "K10" "N-K5" "N-FK5" "N-FK51A" "N-PK51" "N-PK52A" "N-PSK53A" "N-ZK7" "N-BAK1" "N-BAK4"
    "N-SK5" "N-SK16" "N-SSK8" "N-KF9" "N-BAF10" "N-LAK8" "N-LAK9" "N-LAK22" "N-LAF2" "N-LAF21" "N-LASF9"
    "N-LASF31A" "N-LASF44" "LASF35" "N-KZFS4" "N-KZFS8" "LLF1" "LF5" "F2" "N-F2" "F5" "N-SF5" "SF5" "SF6"
    "N-SF6" "N-SF10" "SF10" "N-SF11" "SF11" "N-SF14" "N-SF57" "SF57" "N-SF66" "fused-silica" "quartz-o"
    "quartz-e" "sapphire-o" "sapphire-e" "calcite-o" "calcite-e" "rutile-o" "rutile-e" "MgF2-o" "CaF2" "BaF2"
    "LiF" "NaCl" "diamond" "cubic-zirconia" "strontium-titanate" "YAG" "water" "ice" "ethanol" "PMMA"
    "polycarbonate" "polystyrene" "air"
);

const METAL_FILES: &[(&str, &str)] = files!("metals": "Ag" "Al" "Au" "Cr" "Cu" "Fe" "Ni" "Ti" "W");

#[cfg(test)]
mod tests;
