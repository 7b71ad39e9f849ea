//! Law: the program as a process keeps the promises of a filter. A wrong program would hold answers back until its
//! input ends, exit with 0 after an error, write anything else to standard error, or complain about a broken pipe.

use crate::runner::rapidity;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Output, Stdio};

const GOOD: &str = "{\"ask\": \"boost\", \"celerity\": [0.75, 0, 0], \"event\": [1, 0, 0, 0]}\n";
const GOOD_ANSWER: &str = "{\"event\":[1.25,-0.75,0.0,0.0]}\n";

fn start(arguments: &[&str]) -> Child {
    rapidity(Path::new("."), arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Runs `rapidity probe` on an input to the end.
fn probe(input: &str) -> Output {
    let mut child = start(&["probe"]);
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn the_exit_status_says_whether_all_lines_were_answered() {
    let good = probe(&GOOD.repeat(2));
    assert_eq!(good.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&good.stdout), GOOD_ANSWER.repeat(2));
    let bad = probe(&format!("{GOOD}{{}}\n{GOOD}"));
    assert_eq!(bad.status.code(), Some(1));
    let answers = String::from_utf8_lossy(&bad.stdout).into_owned();
    assert!(answers.starts_with(&format!("{GOOD_ANSWER}{{\"error\":")) && answers.ends_with(GOOD_ANSWER), "{answers}");
    assert_eq!([good.stderr, bad.stderr], [b"", b""]);
}

#[test]
fn an_answer_comes_while_the_input_is_still_open() {
    let mut child = start(&["probe"]);
    let (mut questions, mut answers) = (child.stdin.take().unwrap(), BufReader::new(child.stdout.take().unwrap()));
    for _ in 0..3 {
        questions.write_all(GOOD.as_bytes()).unwrap();
        let mut answer = String::new();
        answers.read_line(&mut answer).unwrap();
        assert_eq!(answer, GOOD_ANSWER);
    }
    drop(questions);
    assert!(child.wait().unwrap().success());
}

#[test]
fn a_reader_that_goes_away_ends_the_program_in_peace() {
    let mut child = start(&["probe"]);
    drop(child.stdout.take());
    // The program may have ended before it has read everything.
    let _ = child.stdin.take().unwrap().write_all(GOOD.repeat(1000).as_bytes());
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

#[test]
fn a_mistake_on_the_command_line_is_told_once_and_exits_with_two() {
    for (arguments, told) in [
        (vec!["probe", "--fast"], "--fast"),
        (vec!["render", "--out", "a.png", "--celerity", "1,0,0", "--beta", "-0.5,0,0"], "--beta"),
        (vec!["ride", "--verify"], "--replay"),
    ] {
        let output = start(&arguments).wait_with_output().unwrap();
        let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(sentence.starts_with("rapidity: ") && sentence.contains(told), "{sentence}");
        assert_eq!((sentence.lines().count(), output.stdout.len()), (1, 0), "{sentence}");
    }
}

#[test]
fn help_goes_to_standard_output() {
    for arguments in [["--help"].as_slice(), &["probe", "--help"], &["--version"]] {
        let output = start(arguments).wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert!(String::from_utf8_lossy(&output.stdout).contains("rapidity") && output.stderr.is_empty());
    }
}
