//! Built-in displays: `app/displays/*.toml`, which are also the examples of the documentation.

/// Names of the built-in displays.
pub const NAMES: [&str; 7] = ["window", "desk", "stereo-wall", "cave4", "cave6", "curved", "dome6"];

/// Texts of the built-in displays' files, in the order of [`NAMES`].
const TEXTS: [&str; 7] = [
    include_str!("../../displays/window.toml"),
    include_str!("../../displays/desk.toml"),
    include_str!("../../displays/stereo-wall.toml"),
    include_str!("../../displays/cave4.toml"),
    include_str!("../../displays/cave6.toml"),
    include_str!("../../displays/curved.toml"),
    include_str!("../../displays/dome6.toml"),
];

/// Text of a built-in display's file, by one of [`NAMES`].
pub fn text(name: &str) -> Option<&'static str> {
    NAMES.iter().position(|known| *known == name).map(|index| TEXTS[index])
}
