//! Display files mean what they say, and each flaw is named with its file, line, key and reason.
use glam::DVec3;
use rapidity::room::{Eye, Surface, file};
use std::path::Path;

const CORE: &str = r#"
[viewer]
eye_separation = 0.064
[[screen]]
name = "front"
lower_left  = [-1.5, 0.0, -1.5]
lower_right = [ 1.5, 0.0, -1.5]
upper_left  = [-1.5, 3.0, -1.5]
[[window]]
name = "main"
size = [960, 480]
[[channel]]
name = "front-left"            # its picture's file name
screen = "front"
eye = "left"                   # left | right | centre
window = "main"
viewport = [0, 0, 480, 480]    # x, y, width, height in the window, pixels from its upper left
"#;

#[test]
fn the_core_of_the_schema_is_read_as_written() {
    let display = file::parse(CORE, "core.toml", Path::new("")).unwrap();
    assert_eq!(display.viewer.eye_separation_m, 0.064);
    let Surface::Flat(flat) = &display.screens[0].surface else { panic!("not flat") };
    assert_eq!(flat.lower_left, DVec3::new(-1.5, 0.0, -1.5));
    assert_eq!(flat.up, DVec3::Y * 3.0);
    assert_eq!(display.windows[0].size, [960, 480]);
    let channel = &display.channels[0];
    assert_eq!((channel.name.as_str(), channel.eye, channel.viewport), ("front-left", Eye::Left, [0, 0, 480, 480]));
}
