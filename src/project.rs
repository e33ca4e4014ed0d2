//! The short way from a scene file to a picture: load, render, develop, save.

use crate::develop::{self, Picture};
use crate::film::Film;
use crate::io::{output, png};
use crate::render::{self, Rendering};
pub use crate::scene::description::DevelopDescription as DevelopSettings;
use crate::scene::description::{self, Parsed, SceneDescription};
use crate::scene::{Compiled, FilmSettings, RenderSettings, Scene, compile};
use crate::{Error, ErrorKind, Result};
use std::path::Path;

/// A scene with all that its file says about the picture. The settings may be changed before rendering.
#[derive(Debug)]
pub struct Project {
    /// The compiled scene.
    pub scene: Scene,
    /// How to sample it.
    pub render: RenderSettings,
    /// Size of the picture and its reconstruction filter.
    pub film: FilmSettings,
    /// How the film becomes a picture.
    pub develop: DevelopSettings,
    /// What deserves a look in the scene file, one line each.
    pub warnings: Vec<String>,
}

impl Project {
    /// Compiles a description: reads the files it names and builds all that rendering needs.
    ///
    /// # Errors
    /// Those of [`compile`].
    pub fn compile(description: &SceneDescription) -> Result<Self> {
        let Compiled { scene, render, film, warnings } = compile(description)?;
        Ok(Self { scene, render, film, develop: description.develop, warnings })
    }

    fn new(parsed: Parsed) -> Result<Self> {
        let mut project = Self::compile(&parsed.description)?;
        project.warnings.splice(0..0, parsed.warnings);
        Ok(project)
    }
}

/// Loads a scene file and the files that it names.
///
/// # Errors
/// Whatever is wrong with the scene, with the file and the JSON path of the place.
pub fn load(path: impl AsRef<Path>) -> Result<Project> {
    Project::new(description::parse_file(path.as_ref())?)
}

/// Loads a scene from the text of a scene file. Files that it names are looked for beside `path`, which errors name.
///
/// # Errors
/// As for [`load`].
pub fn load_str(text: &str, path: impl AsRef<Path>) -> Result<Project> {
    Project::new(description::parse_str(text, path.as_ref())?)
}

/// Renders a project on all threads of rayon's current pool. [`render::render`] also tells its progress and can be stopped.
pub fn render(project: &Project) -> Rendering {
    render::render(&project.scene, &project.render, &project.film, &mut |_| true)
}

impl Film {
    /// Develops the film into a picture to be shown.
    pub fn develop(&self, settings: &DevelopSettings) -> Picture {
        develop::develop(&self.to_image(), settings.exposure_ev, settings.tonemap)
    }
}

impl Picture {
    /// Writes the picture as a PNG, which replaces a file of that name only when it is complete.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a name that does not end in `.png`, [`ErrorKind::Io`].
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = path.as_ref();
        if !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png")) {
            let message = "pictures are written as PNG; expected a name that ends in .png";
            return Err(Error::new(ErrorKind::Unsupported, message).in_file(path));
        }
        output::write_atomically(path, &png::encode(self)?)
    }
}
