//! `rapidity town`: the built-in old town as a glTF file.

use crate::command::{SceneChoice, TownOptions};
use crate::error::Error;
use crate::output::files::writable;
use crate::output::say::tell;
use crate::session::scenes;
use ride::LightSpeed;
use scene_files::export::write_glb;

/// Carries out `rapidity town`.
///
/// # Errors
/// A file that cannot be written.
pub fn town(options: &TownOptions) -> Result<(), Error> {
    writable(&options.out)?;
    let scene = scenes::load(&SceneChoice::Town, LightSpeed::OLD_TOWN.speed_of_light_m_s())?;
    write_glb(&scene, &options.out)?;
    tell(format_args!("wrote {}: {} triangles", options.out.display(), scene.triangle_count()));
    Ok(())
}
