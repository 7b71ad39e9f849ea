//! Law: the examples of docs/FILMS.md are paths, as they stand there. A wrong document teaches words that are refused.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a failed construction is a failed test")]

use crate::support::{assert_derivatives, try_path};
use std::path::Path;

#[test]
fn the_examples_are_paths() {
    let document = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/FILMS.md");
    let text = std::fs::read_to_string(document).unwrap();
    let mut examples = vec![String::new()];
    for line in text.lines() {
        match line.strip_prefix("    ") {
            Some(example) => examples.last_mut().unwrap().push_str(&format!("{example}\n")),
            None if line.is_empty() => examples.last_mut().unwrap().push('\n'),
            None => examples.push(String::new()),
        }
    }
    let examples = examples.iter().filter(|example| example.contains(" = "));
    let mut count = 0;
    for example in examples {
        let path = try_path(example, 10.0).unwrap_or_else(|error| panic!("{error} in\n{example}"));
        if path.scenes().len() == 1 {
            assert_derivatives(&path, 10.0, 1e-5);
        }
        count += 1;
    }
    assert_eq!(count, 4);
}
