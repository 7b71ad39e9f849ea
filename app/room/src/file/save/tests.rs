//! Law under test: saving changes the nudged corners and nothing else. A wrong program would lose comments, reorder
//! other keys, or write corners that are read back as others.

use super::*;
use crate::file::parse::parse;
use crate::warp::{CornerWarp, Warp};

/// Display file as a user may write it: comments, an unusual order, corners in every form.
const FILE: &str = r#"# our wall, measured in May
name = "wall"   # the large one

[[window]]
size = [400, 200]
name = "w"

[[screen]]   # plaster
name = "s"
centre = [0, 1.5, -2]
size = [4.0, 2.0]

[[channel]]
name = "a"      # no corners yet
screen = "s"
window = "w"
viewport = [0, 0, 200, 200]

# the right half
[[channel]]
name = "b"
corners = { upper_left = [1.5, 2], lower_right = [199, 198.25] }   # by eye
screen = "s"
window = "w"
viewport = [200, 0, 100, 200]

[[channel]]
screen = "s"
name = "c"
window = "w"
viewport = [300, 0, 100, 200]
[channel.corners]
upper_left = [3, 3]  # near the door
"#;

/// Corners of a viewport of 200 × 200 pixels, moved a little.
const PLACES: [DVec2; 4] =
    [DVec2::new(1.5, 2.0), DVec2::new(190.0, 0.0), DVec2::new(199.0, 198.25), DVec2::new(-3.0, 200.0)];

fn corners(text: &str, channel: usize) -> Option<Warp> {
    parse(text, "d.toml", Path::new("")).unwrap().channels[channel].warp.clone()
}

/// Warp of a display whose corners are at `places`, pixels, in a viewport of `size` pixels.
fn warp(places: [DVec2; 4], size: DVec2) -> Option<Warp> {
    Some(Warp::Corners(CornerWarp::new(places.map(|place| place / size)).unwrap()))
}

#[test]
fn nothing_nudged_changes_nothing() {
    assert_eq!(saved(FILE, &[]).unwrap(), FILE);
}

#[test]
fn nudged_corners_come_back_and_all_other_lines_stay() {
    let text = saved(FILE, &[("a", Some(PLACES))]).unwrap();
    assert_eq!(corners(&text, 0), warp(PLACES, DVec2::splat(200.0)));
    let added: Vec<_> = text.lines().filter(|line| !FILE.lines().any(|before| before == *line)).collect();
    assert_eq!(added.len(), 1, "{added:?}");
    let without: String = text.lines().filter(|line| *line != added[0]).map(|line| format!("{line}\n")).collect();
    assert_eq!(without, FILE);
}

#[test]
fn corners_that_are_there_keep_their_comments_and_what_has_not_moved() {
    let size = DVec2::new(100.0, 200.0);
    let places = [DVec2::new(1.5, 2.0), DVec2::new(98.0, 1.0), DVec2::new(99.0, 198.25), DVec2::new(0.0, 200.0)];
    let text = saved(FILE, &[("b", Some(places)), ("c", Some(places))]).unwrap();
    for channel in [1, 2] {
        assert_eq!(corners(&text, channel), warp(places, size));
    }
    assert!(text.contains("corners = { upper_left = [1.5, 2], lower_right = [99.0, 198.25]"), "{text}");
    assert!(text.contains("}   # by eye\n"), "{text}");
    assert!(text.contains("upper_left = [1.5, 2.0]  # near the door\n"), "{text}");
    // Saving the same corners once more changes nothing.
    assert_eq!(saved(&text, &[("b", Some(places)), ("c", Some(places))]).unwrap(), text);
}

#[test]
fn the_viewports_corners_need_no_key() {
    for (name, channel) in [("b", 1), ("c", 2)] {
        let text = saved(FILE, &[(name, None)]).unwrap();
        assert_eq!(corners(&text, channel), None);
        assert!(text.contains("# our wall") && text.contains("# the right half"), "{text}");
    }
}

#[test]
fn channels_in_one_line_are_found_too() {
    let (head, _) = FILE.split_once("[[channel]]").unwrap();
    let inline = format!("channel = [{{ name = \"a\", screen = \"s\", window = \"w\" }}]\n{head}");
    let text = saved(&inline, &[("a", Some(PLACES))]).unwrap();
    assert_eq!(corners(&text, 0), warp(PLACES, DVec2::new(400.0, 200.0)));
}

#[test]
fn a_channel_that_is_not_there_is_an_error() {
    let missing = saved(FILE, &[("a", Some(PLACES)), ("d", None)]);
    assert!(matches!(missing, Err(SaveError::NoChannel { name }) if name == "d"));
    assert!(matches!(saved("channel = 3", &[("a", None)]), Err(SaveError::NoChannel { .. })));
    assert!(matches!(saved("[[channel", &[]), Err(SaveError::Syntax(_))));
    let odd = FILE.replace("name = \"a\" ", "corners = 3\nname = \"a\"");
    assert!(matches!(saved(&odd, &[("a", Some(PLACES))]), Err(SaveError::NoTable { .. })));
}

#[test]
fn a_file_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.toml");
    std::fs::write(&path, FILE).unwrap();
    let name = path.to_str().unwrap();
    save(name, &[("a", Some(PLACES))]).unwrap();
    let written = std::fs::read_to_string(&path).unwrap();
    assert_eq!(written, saved(FILE, &[("a", Some(PLACES))]).unwrap());

    // Crossed corners are no picture: they are not written, and no partial file is left behind.
    let crossed = [PLACES[2], PLACES[1], PLACES[0], PLACES[3]];
    assert!(matches!(save(name, &[("a", Some(crossed))]), Err(SaveError::Display(_))));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), written);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn what_has_no_file_of_ours_says_how_to_get_one() {
    let built_in = save("stereo-wall", &[]).unwrap_err().to_string();
    assert!(built_in.contains("app/displays/stereo-wall.toml"), "{built_in}");
    let imported = save("cave.pvx", &[]).unwrap_err().to_string();
    assert!(imported.contains("only read"), "{imported}");
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link_and_names_files_from_its_own_folder() {
    let [lab, store] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    let (link, target) = (lab.path().join("wall.toml"), store.path().join("wall.toml"));
    let mesh = "u,v,x,y,z\n0,0,-1,0,-2\n1,0,1,0,-2\n0,1,-1,2,-2\n1,1,1,2,-2\n";
    std::fs::write(lab.path().join("wall.csv"), mesh).unwrap();
    let text = FILE.replace("centre = [0, 1.5, -2]\nsize = [4.0, 2.0]", "mesh = \"wall.csv\"");
    std::fs::write(&target, &text).unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    assert!(crate::display::Display::load(&link).is_ok());
    save(link.to_str().unwrap(), &[("a", Some(PLACES))]).unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read_to_string(&target).unwrap(), saved(&text, &[("a", Some(PLACES))]).unwrap());
}
