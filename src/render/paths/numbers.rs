//! The random numbers of a vertex, by what they decide.

use crate::sampling::DIMENSIONS;

/// How a kind of path deals out the eight numbers of a vertex. Which dimension decides what matters to how well pairs of
/// decisions are spread jointly, and is therefore not the same for all kinds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// For paths whose vertices ask for light, each with numbers of the vertex before it: a vertex's direction and the point
    /// on a light that the next vertex asks multiply in effect, and come from one net.
    AskLights,
    /// For all other paths.
    Plain,
}

/// The random numbers of a vertex, each in [0, 1). A model or technique that needs more than eight draws another group of
/// the path's sequence, whose groups beyond the largest depth are free.
#[derive(Debug, Clone, Copy)]
pub struct VertexNumbers {
    /// Draws the direction in which the path goes on.
    pub direction: [f32; 2],
    /// Chooses between reflection and refraction.
    pub choice: f32,
    /// Decides whether the path survives.
    pub roulette: f32,
    /// Draws the point on the lens or on a light to which this vertex is connected.
    pub connection: [f32; 2],
    /// Draws the point on a light to which the next vertex is connected.
    pub next_connection: [f32; 2],
}

impl VertexNumbers {
    /// Deals out a group of the sequence.
    #[inline(always)]
    pub fn new(layout: Layout, u: [f32; DIMENSIONS]) -> Self {
        let (direction, connection) = ([u[0], u[1]], [u[4], u[5]]);
        match layout {
            Layout::AskLights => {
                Self { direction, next_connection: [u[2], u[3]], connection, roulette: u[6], choice: u[7] }
            }
            Layout::Plain => {
                Self { direction, choice: u[2], roulette: u[3], connection, next_connection: [u[6], u[7]] }
            }
        }
    }
}
