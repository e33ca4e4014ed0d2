//! Light transport techniques, one file each, and the table that says which of them finds which paths.

pub mod baseline;
mod camera;
mod guide;
mod light;
mod merge;
mod photons;
mod start_numbers;
mod table;
#[cfg(test)]
mod tests;

pub use camera::{radiance, radiance_ratio};
pub use guide::{Experience, Guide};
pub use light::{LightTracer, Splatter};
pub use merge::{BLUR_DECAY, Merging, PhotonCollector, follow_specular};
pub use photons::PhotonMap;
pub use start_numbers::CameraNumbers;
pub use table::Techniques;
