//! What a path carries from vertex to vertex: the flux of its lanes, which of them are alive, and how likely each was to lead.

use crate::spectrum::{LANES, SampledSpectrum};

/// A least share that no part has: paths never fork.
pub const NEVER: f32 = 2.0;

/// Wavelengths of a path of the baseline `hero` \[PBRT4\].
pub const BASELINE_LANES: usize = 4;

/// Which lanes of a path are alive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lanes {
    /// All share the ray.
    Shared,
    /// They have parted and each goes its own way with the same random numbers; this is one of those ways.
    Bundled(usize),
    /// They have parted and only this one goes on: it stands for all.
    Only(usize),
}

impl Lanes {
    /// The lane that is alone on the ray, if one is.
    pub fn single(self) -> Option<usize> {
        match self {
            Self::Shared => None,
            Self::Bundled(lane) | Self::Only(lane) => Some(lane),
        }
    }
}

/// What becomes of lanes that share a ray where a refraction sends them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parting {
    /// So many of them (1, 2, 4 or 8), evenly spread and the hero among them, go on for all, each its own way, up to
    /// their first diffuse surface. From there the hero stands for all.
    Ways(u8),
    /// The hero stands for all from wherever a dispersive surface is met, whatever happens there: the state of the art that
    /// `hero` is kept for \[PBRT4\].
    Terminate,
}

impl Parting {
    /// Whether several lanes go on where a refraction sends them apart.
    pub fn keeps_several(self) -> bool {
        matches!(self, Self::Ways(2..))
    }
}

/// Where a path branches.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branching {
    /// What becomes of lanes where a refraction sends them apart.
    pub parting: Parting,
    /// The path forks where both parts carry at least this share of what it started with.
    pub least_share: f32,
}

/// The spectral state of a path. A scattering model reads it, and the walk changes it by what the model answers.
#[derive(Debug, Clone, Copy)]
pub struct Carried {
    /// Flux of each lane, in units of what the path started with.
    pub throughput: SampledSpectrum,
    /// Which lanes are alive.
    pub lanes: Lanes,
    /// The lane that goes on where only one does, and that draws directions for all where each would draw its own.
    pub hero: usize,
    /// Number of lanes times the probability of each to be the hero, given the path so far: 1 until the hero draws
    /// directions, see [`super::RoughDielectric`]. These are the weights of spectral MIS.
    pub odds: SampledSpectrum,
    /// What happens where lanes part.
    pub parting: Parting,
    /// Where the path forks: see [`Branching::least_share`].
    pub least_share: f32,
}

impl Carried {
    /// All lanes at full flux.
    pub fn new(hero: usize, Branching { parting, least_share }: Branching) -> Self {
        let (throughput, odds) = (SampledSpectrum::ONE, SampledSpectrum::ONE);
        Self { throughput, lanes: Lanes::Shared, hero, odds, parting, least_share }
    }

    /// Lanes that a path starts with.
    pub fn lanes_at_start(&self) -> f32 {
        if self.parting == Parting::Terminate { BASELINE_LANES as f32 } else { LANES as f32 }
    }

    /// Share of what the path started with that it carries. The mean over lanes counts a lane that stands for all like all
    /// that share the ray. One of a bundle counts as it would if it were alone.
    pub fn share(&self) -> f32 {
        match (self.lanes, self.parting) {
            (Lanes::Bundled(_), Parting::Ways(ways)) => self.throughput.mean() * f32::from(ways),
            _ => self.throughput.mean(),
        }
    }

    /// Whether both parts of a path are followed, of which one is the share `reflected` of its flux.
    pub(crate) fn forks(&self, reflected: f32) -> bool {
        self.least_share < NEVER && self.share() * reflected.min(1.0 - reflected) >= self.least_share
    }

    /// The lanes that go on where lanes that share the ray part: the hero first, the others evenly spread.
    pub fn ways(&self) -> impl Iterator<Item = usize> + use<> {
        let (hero, ways) = (self.hero, if let Parting::Ways(ways) = self.parting { ways } else { 1 });
        (0..ways).map(move |way| lane_of_way(hero, ways, way))
    }

    /// Lets the hero stand for all lanes that shared the ray.
    pub fn leave_to_hero(&mut self) {
        if self.lanes == Lanes::Shared {
            self.lanes = Lanes::Only(self.hero);
            self.throughput = self.throughput.only(self.hero) * (self.lanes_at_start() / self.odds.lane(self.hero));
        }
    }

    /// Sum of the odds of the lanes that go on where `ways` do, each of which would have led to the same ways: as many as
    /// there are ways, where lanes are equally likely.
    pub fn odds_of_any(&self, ways: u8) -> f32 {
        let odds = self.odds.lanes();
        (0..ways).map(|way| odds[lane_of_way(self.hero, ways, way)]).sum()
    }

    /// Ends a bundle at a matte surface: only the hero continues, for all lanes. Returns `false` if this lane ends. Call it
    /// at every matte vertex, before the path goes on.
    pub fn end_bundle(&mut self) -> bool {
        if let Lanes::Bundled(lane) = self.lanes {
            if lane != self.hero {
                return false;
            }
            self.lanes = Lanes::Only(lane);
            if let Parting::Ways(ways) = self.parting {
                self.throughput *= self.odds_of_any(ways) / self.odds.lane(lane);
            }
        }
        if self.parting != Parting::Terminate {
            self.parting = Parting::Ways(1);
        }
        true
    }
}

/// The lane that takes the `way`-th of so many ways.
pub fn lane_of_way(hero: usize, ways: u8, way: u8) -> usize {
    (hero + usize::from(way) * (LANES / usize::from(ways))) % LANES
}
