//! Where light paths start: which light, and where in the pair of random numbers that decides what its paths meet.

use crate::sampling::{AliasTable, Draw, GridDensity};
use crate::scene::{Aim, Exit, GuidedPair, Light, LightId, Scene};

/// Cells along each side of a light's grid.
pub const SIDE: usize = 32;
/// Share of the paths that go wherever they could, however little has been seen of it: no weight can exceed that of an
/// unguided path by more than its inverse.
const DEFENSIVE: f64 = 0.2;

/// Densities of light paths, learnt from a pilot or as the scene alone suggests them.
#[derive(Debug, Clone)]
pub struct Guide {
    lights: AliasTable,
    /// The grid of each light; `None` if all its cells are equally likely.
    grids: Vec<Option<GridDensity>>,
}

impl Guide {
    /// Draws lights by a table and starts paths evenly: nothing is learnt yet.
    pub fn plain(lights: AliasTable, scene: &Scene) -> Self {
        Self { lights, grids: vec![None; scene.lights.len()] }
    }

    /// Draws a light.
    pub fn sample_light(&self, u: f32) -> Option<Draw> {
        self.lights.sample(u)
    }

    /// Returns the probability of a light.
    pub fn probability(&self, LightId(light): LightId) -> f32 {
        self.lights.probability(light as usize)
    }

    /// Moves the guided one of two pairs of random numbers. Returns the density by which to divide the path's weight.
    pub fn warp(&self, LightId(light): LightId, pair: Option<GuidedPair>, u: &mut [f32; 2], v: &mut [f32; 2]) -> f32 {
        let (Some(grid), Some(pair)) = (&self.grids[light as usize], pair) else { return 1.0 };
        let numbers = match pair {
            GuidedPair::Point => u,
            GuidedPair::Direction => v,
        };
        *numbers = grid.sample(*numbers);
        grid.density(*numbers)
    }

    /// Returns the density of light that leaves in this way, relative to that of an unguided path.
    pub fn density(&self, LightId(index): LightId, light: &Light, exit: &Exit, aim: &Aim) -> f32 {
        let Some(grid) = &self.grids[index as usize] else { return 1.0 };
        light.guided_numbers(exit, aim).map_or(1.0, |numbers| grid.density(numbers))
    }
}

/// What a pilot saw of each light and cell, with the densities of the plain guide that it used.
#[derive(Debug)]
pub struct Experience {
    /// Cells of each light, each with its number of paths and the sum of squares of what they contributed.
    lights: Vec<Vec<[f64; 2]>>,
}

impl Experience {
    /// Makes an empty record.
    pub fn new(scene: &Scene) -> Self {
        Self { lights: vec![vec![[0.0; 2]; SIDE * SIDE]; scene.lights.len()] }
    }

    /// Adds a path that contributed `square` (the sum of squares over the picture).
    pub fn add(&mut self, LightId(light): LightId, numbers: [f32; 2], square: f64) {
        let [row, column] = numbers.map(|c| ((c * SIDE as f32) as usize).min(SIDE - 1));
        let cell = &mut self.lights[light as usize][row * SIDE + column];
        cell[0] += 1.0;
        cell[1] += square;
    }

    /// The best densities for what was seen, mixed with a defensive share: variance is least with densities in proportion
    /// to root mean squares.
    pub fn guide(&self, plain: &Guide, scene: &Scene) -> Guide {
        let mut grids = Vec::new();
        let mut of_light = Vec::new();
        let paths: f64 = self.lights.iter().flatten().map(|c| c[0]).sum();
        for (light, cells) in scene.lights.iter().zip(&self.lights) {
            let drawn: f64 = cells.iter().map(|c| c[0]).sum();
            if drawn == 0.0 {
                grids.push(None);
                of_light.push(0.0);
                continue;
            }
            let mean_squares = smoothed(&cells.iter().map(|c| c[1] / c[0].max(1.0)).collect::<Vec<_>>());
            let unguided = mean_squares.iter().sum::<f64>() / mean_squares.len() as f64;
            let density = defensive(&mean_squares.iter().map(|s| s.sqrt()).collect::<Vec<_>>());
            let guided = mean_squares.iter().zip(&density).map(|(s, p)| s / p).sum::<f64>() / density.len() as f64;
            let worthwhile = light.guided_pair().is_some() && guided < unguided;
            let second_moment = if worthwhile { guided } else { unguided };
            // Contributions hold 1 / probability of the light: without it, they are of the light alone.
            let share = drawn / paths;
            of_light.push(share * second_moment.sqrt());
            grids.push(worthwhile.then(|| GridDensity::new(SIDE, &density)));
        }
        let learnt = defensive_over(&of_light, |l| f64::from(plain.probability(LightId(l as u32))));
        Guide { lights: AliasTable::new(&learnt), grids }
    }
}

/// Returns densities of mean 1 in proportion to some weights, mixed with a constant density.
fn defensive(weights: &[f64]) -> Vec<f64> {
    let mean = weights.iter().sum::<f64>() / weights.len() as f64;
    weights.iter().map(|w| if mean > 0.0 { DEFENSIVE + (1.0 - DEFENSIVE) * w / mean } else { 1.0 }).collect()
}

/// Returns probabilities in proportion to some weights, mixed with plain ones.
fn defensive_over(weights: &[f64], plain: impl Fn(usize) -> f64) -> Vec<f64> {
    let total: f64 = weights.iter().sum();
    let learnt = |w: f64| if total > 0.0 { w / total } else { 0.0 };
    let share = if total > 0.0 { DEFENSIVE } else { 1.0 };
    weights.iter().enumerate().map(|(i, &w)| share * plain(i) + (1.0 - share) * learnt(w)).collect()
}

/// Each cell with half of what its neighbours have: what is bright may start at the edge of a cell.
fn smoothed(cells: &[f64]) -> Vec<f64> {
    let at = |row: isize, column: isize| {
        let inside = |c: isize| (0..SIDE as isize).contains(&c);
        if inside(row) && inside(column) { cells[row as usize * SIDE + column as usize] } else { 0.0 }
    };
    (0..cells.len())
        .map(|i| {
            let (row, column) = ((i / SIDE) as isize, (i % SIDE) as isize);
            let neighbors = at(row - 1, column) + at(row + 1, column) + at(row, column - 1) + at(row, column + 1);
            0.5 * at(row, column) + 0.125 * neighbors
        })
        .collect()
}
