//! `rapidity town`: the built-in old town as a glTF file.

use crate::error::Error;
use crate::output::say::tell;
use built_in::town;
use command::TownOptions;
use picture_files::files::writable;
use scene_files::export::write_glb;

/// Carries out `rapidity town`.
///
/// # Errors
/// A file that cannot be written.
pub fn town(options: &TownOptions) -> Result<(), Error> {
    writable(&options.out)?;
    let scene = town::build(town::TOWN_SEED);
    write_glb(&scene, &options.out)?;
    tell(format_args!("wrote {}: {} triangles", options.out.display(), scene.triangle_count()));
    Ok(())
}
