//! The driver: splits a picture into pieces of work that any number of threads can do in any order with the same bits.

mod adaptive;
mod allocation;
mod blocks;
mod camera_pass;
mod camera_path;
mod job;
mod light_pass;
mod merging;
mod outcome;
mod pilot;
mod plan;
mod profile;
mod run;
mod schedule;
mod state;
mod stopping;
mod streams;
mod threads;
mod tiles;

pub use outcome::{Progress, Rendering, Statistics};
pub use plan::{Decisions, blind_spot};
pub use profile::{Phase, Profile};
pub use run::run;
