//! Renders a scene file to a PNG: `cargo run --release --example render -- scenes/prism.json prism.png`.

fn main() -> abbe::Result<()> {
    let mut arguments = std::env::args().skip(1);
    let scene = arguments.next().unwrap_or_else(|| "scenes/prism.json".into());
    let picture = arguments.next().unwrap_or_else(|| "picture.png".into());
    let mut project = abbe::load(scene)?;
    project.render.samples_per_pixel = 16;
    let rendering = abbe::render(&project);
    rendering.film.develop(&project.develop).save(picture)
}
