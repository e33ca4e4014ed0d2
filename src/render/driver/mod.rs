//! The driver: splits a picture into pieces of work that any number of threads can do in any order with the same bits.

mod adaptive;
mod allocation;
mod merging;
mod outcome;
mod passes;
mod pilot;
mod plan;
mod profile;
mod renderer;
mod run;
mod schedule;
mod state;
mod stopping;
mod streams;

pub use outcome::{Progress, Rendering, Statistics};
pub use plan::{Decisions, blind_spot};
pub use profile::{Phase, Profile};
pub use run::run;
