//! The index of refraction of a glass of the catalogue at a few wavelengths: `cargo run --example glass_index -- N-SF11`.

use abbe::io::catalogue;

fn main() -> abbe::Result<()> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "N-BK7".into());
    let index = catalogue::glass(&name)?.constants()?.n;
    println!("{name}: n_d {:.5}, V_d {:.2}", index.n_d(), index.abbe_number());
    for lambda_nm in [400.0, 500.0, 600.0, 700.0] {
        println!("{lambda_nm} nm: {:.5}", index.eval(lambda_nm));
    }
    Ok(())
}
