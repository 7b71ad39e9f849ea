//! Law: every line that is not blank gets exactly one line in return, in order, whatever it holds. A line that cannot
//! be answered gets a sentence that says what is wrong, under which key, and what was expected. A wrong program would
//! lose its place after a bad line, swallow a misspelt key, write null for a number, or crash.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]

use std::io::{self, BufReader, Read, Write};

use probe::LONGEST_LINE;
use serde_json::Value;

const GOOD: &str = r#"{"ask": "boost", "celerity": [0.75, 0, 0], "event": [1, 0, 0, 0]}"#;
const GOOD_ANSWER: &str = r#"{"event":[1.25,-0.75,0.0,0.0]}"#;

/// Answers to an input, and true if every line was answered.
fn run(input: &[u8]) -> (Vec<String>, bool) {
    let mut output = Vec::new();
    let all_answered = probe::run(input, &mut output).unwrap();
    let output = String::from_utf8(output).unwrap();
    assert!(output.is_empty() || output.ends_with('\n'));
    (output.lines().map(str::to_owned).collect(), all_answered)
}

/// Sentence with which a line is refused.
fn refusal(line: &[u8]) -> String {
    let (answers, all_answered) = run(line);
    assert!(!all_answered && answers.len() == 1, "{answers:?}");
    let answer: Value = serde_json::from_str(&answers[0]).unwrap();
    let keys: Vec<_> = answer.as_object().unwrap().keys().collect();
    assert_eq!(keys, ["error"], "{answer}");
    answer["error"].as_str().unwrap().to_owned()
}

#[test]
fn good_lines_are_answered_in_order() {
    let other = GOOD.replace("[1, 0, 0, 0]", "[0, 1, 0, 0]");
    let (answers, all_answered) = run(format!("{GOOD}\n{other}\r\n{GOOD}").as_bytes());
    assert_eq!(answers, [GOOD_ANSWER, r#"{"event":[-0.75,1.25,0.0,0.0]}"#, GOOD_ANSWER]);
    assert!(all_answered);
}

#[test]
fn blank_lines_are_skipped() {
    let (answers, all_answered) = run(format!("\n  \n\t\r\n{GOOD}\n\n").as_bytes());
    assert_eq!(answers, [GOOD_ANSWER]);
    assert!(all_answered);
    assert_eq!(run(b""), (vec![], true));
}

#[test]
fn after_a_bad_line_the_next_is_read() {
    let deep = format!("{}1{}", "[".repeat(100_000), "]".repeat(100_000));
    let deep_objects = r#"{"ask":"#.repeat(100_000);
    let huge = "x".repeat(3 * LONGEST_LINE);
    let bad: [&[u8]; 9] = [
        b"{",
        b"[]",
        b"\xff\xfe\x00",
        b"{\"ask\": \"\xc3\x28\"}",
        b"\0",
        b"{} {}",
        deep.as_bytes(),
        deep_objects.as_bytes(),
        huge.as_bytes(),
    ];
    for line in bad {
        let (answers, all_answered) = run(&[GOOD.as_bytes(), line, GOOD.as_bytes()].join(&b'\n'));
        assert_eq!(answers.len(), 3);
        assert_eq!([&answers[0], &answers[2]], [GOOD_ANSWER; 2]);
        assert!(answers[1].starts_with(r#"{"error":"#) && answers[1].len() < 1000, "{}", answers[1]);
        assert!(!all_answered);
    }
}

#[test]
fn a_line_may_be_as_long_as_the_limit_and_no_longer() {
    let padded = |length: usize| format!("{GOOD}{}", " ".repeat(length - GOOD.len()));
    for end in ["", "\n"] {
        assert_eq!(run(format!("{}{end}", padded(LONGEST_LINE)).as_bytes()).0, [GOOD_ANSWER]);
        assert!(refusal(format!("{}{end}", padded(LONGEST_LINE + 1)).as_bytes()).contains("too long"));
    }
    let blank = " ".repeat(LONGEST_LINE + 1);
    assert!(refusal(blank.as_bytes()).contains("too long"));
}

#[test]
fn each_answer_is_flushed_before_the_next_question_is_read() {
    /// Reader that gives one line at a time, and only after the answer to the line before has been flushed.
    struct Conversation<'a> {
        flushed: &'a std::cell::Cell<usize>,
        asked: usize,
    }
    impl Read for Conversation<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            assert_eq!(self.flushed.get(), self.asked, "a question was read before the last answer was out");
            self.asked += 1;
            let line = if self.asked <= 3 { format!("{GOOD}\n") } else { String::new() };
            buffer[..line.len()].copy_from_slice(line.as_bytes());
            Ok(line.len())
        }
    }
    struct CountingWriter<'a>(&'a std::cell::Cell<usize>);
    impl Write for CountingWriter<'_> {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            Ok(bytes.len())
        }
        fn flush(&mut self) -> io::Result<()> {
            self.0.set(self.0.get() + 1);
            Ok(())
        }
    }
    let flushed = std::cell::Cell::new(0);
    let reader = BufReader::new(Conversation { flushed: &flushed, asked: 0 });
    assert!(probe::run(reader, CountingWriter(&flushed)).unwrap());
    assert_eq!(flushed.get(), 3);
}

#[test]
fn a_closed_reading_end_stops_without_an_error() {
    struct Broken(io::ErrorKind);
    impl Write for Broken {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let endless = || BufReader::new(io::repeat(b'\n').take(10).chain(io::Cursor::new(format!("{GOOD}\n").repeat(5))));
    assert!(probe::run(endless(), Broken(io::ErrorKind::BrokenPipe)).unwrap());
    let full = probe::run(endless(), Broken(io::ErrorKind::StorageFull)).unwrap_err();
    assert_eq!(full.kind(), io::ErrorKind::StorageFull);
}

#[test]
fn a_line_that_is_no_question_is_refused() {
    for (line, told) in [
        ("{", "EOF while parsing an object"),
        ("\"ask", "EOF while parsing a string"),
        ("nul", "expected"),
        ("[1, 2]", "the line is a list of 2: expected an object"),
        ("3", "the line is 3.0: expected an object"),
        ("null", "the line is null: expected an object"),
        ("{}", "`ask` is missing: expected one of aberration, boost"),
        (r#"{"ask": 3}"#, "`ask` is 3.0: expected one of aberration, boost"),
        (r#"{"ask": "abberation"}"#, "`ask` is the text \"abberation\": expected one of aberration, boost"),
        (r#"{"ask": "boost", "ask": "boost"}"#, "`ask` is given more than once"),
        ("{\"ask\": \"boost\u{0}\"}", "control character"),
    ] {
        let sentence = refusal(line.as_bytes());
        assert!(sentence.contains(told), "{line}\n{sentence}");
    }
}

#[test]
fn a_bad_value_is_refused_with_its_key_and_what_was_expected() {
    let boost = |part: &str| format!(r#"{{"ask": "boost", {part}}}"#);
    let aberration = |part: &str| format!(r#"{{"ask": "aberration", {part}}}"#);
    let worldline = |part: &str| format!(r#"{{"ask": "worldline", {part}}}"#);
    let from_rest = r#""start": {"position": [0,0,0], "celerity": [0,0,0]}"#;
    let leg = r#""legs": [{"duration": 1, "acceleration": [1,0,0]}]"#;
    let eyes =
        |part: &str| format!(r#"{{"ask": "eyes", "observer": {{"position": [0,0,0], "celerity": [0,0,0]}}, {part}}}"#);
    let apparent =
        |observer: &str, source: &str| format!(r#"{{"ask": "apparent", "observer": {observer}, "source": {source}}}"#);
    let rest = r#"{"position": [0,0,0], "celerity": [0,0,0]}"#;
    let perceived = |eyes: &str, part: &str| format!(r#"{{"ask": "perceived", "eyes": {eyes}, {part}}}"#);
    let source = r#""source": {"position": [0,0,-4], "celerity": [0,0,0]}"#;
    let colour = |spectrum: &str, part: &str| format!(r#"{{"ask": "colour", "spectrum": {spectrum}{part}}}"#);
    for (line, told) in [
        (boost(r#""celerity": [0,0,0]"#), "`event` is missing: expected a list of four numbers"),
        (boost(r#""event": [0,0,0,0]"#), "`celerity` is missing: expected a celerity"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0]"#), "`event` is a list of 3: expected a list of four numbers"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,"0",0]"#), "`event[2]` is the text \"0\": expected a number"),
        (boost(r#""celerity": [0,0,0,0], "event": [0,0,0,0]"#), "`celerity` is a list of 4: expected a list of three"),
        (boost(r#""celerity": [0,null,0], "event": [0,0,0,0]"#), "`celerity[1]` is null: expected a number"),
        (boost(r#""celerity": 0.75, "event": [0,0,0,0]"#), "`celerity` is 0.75: expected a list of three numbers"),
        (boost(r#""celerity": [1e76,0,0], "event": [0,0,0,0]"#), "`celerity` is no velocity"),
        (
            boost(r#""beta": [1,0,0], "event": [0,0,0,0]"#),
            "`beta` is no velocity: the velocity [1, 0, 0] is not slower",
        ),
        (boost(r#""beta": [0.6,0.8,0.1], "event": [0,0,0,0]"#), "|beta| must be below 1"),
        (boost(r#""beta": [0,0,0], "celerity": [0,0,0], "event": [0,0,0,0]"#), "`celerity` and `beta` are both given"),
        (
            boost(r#""celerity": [0,0,0], "event": [0,0,0,0], "D": 1"#),
            "`D` is unknown here: expected no other keys than",
        ),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0,0], "event": [0,0,0,0]"#), "`event` is given more than once"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0,1e999]"#), "number out of range"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0,-1e309]"#), "number out of range"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0,NaN]"#), "\"event\": [0,0,0,N`"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0,Infinity]"#), "expected one JSON object a line"),
        (boost(r#""celerity": [2,0,0], "event": [1e308,0,0,0]"#), "the answer's `event` is beyond the range"),
        (boost(r#""celerity": [0,0,0], "event": [0,0,0,0], "a b\n": 1"#), "`\"a b\\n\"` is unknown here"),
        (aberration(r#""celerity": [1,0,0], "direction": [0,0,0]"#), "`direction` is zero: expected a direction"),
        (aberration(r#""celerity": [1,0,0], "direction": [0,-0.0,0]"#), "`direction` is zero: expected a direction"),
        (aberration(r#""celerity": [1,0,0], "direction": [true,0,0]"#), "`direction[0]` is true: expected a number"),
        (r#"{"ask": "compose", "vehicle": [0,0,0]}"#.to_owned(), "`head` is missing: expected a celerity"),
        (
            r#"{"ask": "compose", "vehicle": [0,0,0], "head": {"beta": [1,0,0]}}"#.to_owned(),
            "`head.beta` is no velocity",
        ),
        (r#"{"ask": "compose", "vehicle": {}, "head": [0,0,0]}"#.to_owned(), "`vehicle.celerity` is missing"),
        (r#"{"ask": "compose", "vehicle": {"u": 1}, "head": [0,0,0]}"#.to_owned(), "`vehicle.u` is unknown here"),
        (apparent("3", rest), "`observer` is 3.0: expected an object with the keys position"),
        (apparent(r#"{"position": [0,0,0]}"#, rest), "`observer.celerity` is missing"),
        (apparent(r#"{"celerity": [0,0,0]}"#, rest), "`observer.position` is missing"),
        (apparent(r#"{"position": [0,0,0], "celerity": [0,0,0], "time": "0"}"#, rest), "`observer.time` is the text"),
        (apparent(rest, r#"{"celerity": [0,0,0]}"#), "`source.position` is missing"),
        (apparent(rest, r#"{"position": [0,0,0], "time": 0}"#), "`source.time` is unknown here"),
        (apparent(rest, r#"{"position": [0,0,0], "beta": [0,2,0]}"#), "`source.beta` is no velocity"),
        (apparent(rest, r#"{"position": [0,0,0], "position": [0,0,0]}"#), "`source.position` is given more than once"),
        (eyes(r#""separation": -1, "right": [1,0,0]"#), "`separation` is -1.0: expected a distance"),
        (eyes(r#""separation": [1], "right": [1,0,0]"#), "`separation` is a list of 1: expected a distance"),
        (eyes(r#""separation": 1, "right": [0,0,0]"#), "`right` is zero: expected a direction"),
        (eyes(r#""separation": 1"#), "`right` is missing: expected a direction"),
        (worldline(&format!("{leg}, \"step\": 0.1")), "`start` is missing"),
        (worldline(&format!("{from_rest}, \"step\": 0.1")), "`legs` is missing"),
        (worldline(&format!("{from_rest}, {leg}")), "`step` is missing: expected a number above 0"),
        (worldline(&format!("{from_rest}, {leg}, \"step\": 0")), "`step` is 0.0: expected a number above 0"),
        (worldline(&format!("{from_rest}, {leg}, \"step\": -1")), "`step` is -1.0: expected a number above 0"),
        (worldline(&format!("{from_rest}, {leg}, \"step\": 1e-10")), "`legs` take 10000000000 steps"),
        (worldline(&format!("{from_rest}, {leg}, \"step\": 5e-324")), "expected at most 10000000"),
        (
            worldline(&format!("{from_rest}, {leg}, \"step\": 1, \"integrator\": \"euler\"")),
            "\"rk4\", \"exact\" or \"dopri5\"",
        ),
        (
            worldline(&format!("{from_rest}, {leg}, \"step\": 1, \"integrator\": \"RK4\"")),
            "`integrator` is the text \"RK4\"",
        ),
        (worldline(&format!("{from_rest}, {leg}, \"step\": 1, \"integrator\": 4")), "`integrator` is 4.0"),
        (worldline(&format!("{from_rest}, \"step\": 1, \"legs\": {{}}")), "`legs` is an object: expected a list"),
        (
            worldline(&format!("{from_rest}, \"step\": 1, \"legs\": [[]]")),
            "`legs[0]` is a list of 0: expected an object",
        ),
        (
            worldline(&leg_of(r#""duration": -1, "acceleration": [0,0,0]"#)),
            "`legs[0].duration` is -1.0: expected a number, 0",
        ),
        (worldline(&leg_of(r#""duration": 1"#)), "`legs[0].acceleration` is missing"),
        (worldline(&leg_of(r#""duration": 1, "accelerations": [0,0,0]"#)), "`legs[0].accelerations` is unknown here"),
        (worldline(&leg_of(r#""duration": 1000, "acceleration": [1,0,0]"#)), "leg 0 of `legs` fails"),
        (
            perceived("[[0,0,0]]", &format!(r#"{source}, "time": 0"#)),
            "`eyes` is a list of 1: expected a list of two places",
        ),
        (perceived("[[0,0,0],[1,0]]", &format!(r#"{source}, "time": 0"#)), "`eyes[1]` is a list of 2"),
        (perceived("[[0,0,0],[1,0,0]]", source), "`time` is missing: expected a number"),
        (perceived("[[0,0,0],[0,0,0]]", &format!(r#"{source}, "time": 0"#)), "both eyes are at"),
        (perceived("[[0,0,-4],[1,0,0]]", &format!(r#"{source}, "time": 0"#)), "the source is at the eye"),
        (perceived("[[0,0,0],[0,0,1]]", &format!(r#"{source}, "time": 0"#)), "parallel sight lines"),
        (
            perceived("[[0,0,0],[1,0,0]]", r#""source": {"position": [0,0,1]}, "time": 0"#),
            "`source.celerity` is missing",
        ),
        (
            r#"{"ask": "colour", "D": 1}"#.to_owned(),
            "`spectrum` is missing: expected an object with one of the keys planck",
        ),
        (colour("3", ", \"D\": 1"), "`spectrum` is 3.0: expected an object with one of the keys planck, sampled, rgb"),
        (colour("{}", ", \"D\": 1"), "`spectrum` is an object: expected an object with one of the keys planck"),
        (
            colour(r#"{"planck": 1, "rgb": [1,1,1]}"#, ", \"D\": 1"),
            "`spectrum` is an object: expected an object with one",
        ),
        (colour(r#"{"planck": 1, "planck": 1}"#, ", \"D\": 1"), "`spectrum.planck` is given more than once"),
        (
            colour(r#"{"plank": 1}"#, ", \"D\": 1"),
            "`spectrum.plank` is unknown here: expected no other keys than planck, sa",
        ),
        (colour(r#"{"planck": "hot"}"#, ", \"D\": 1"), "`spectrum.planck` is the text \"hot\": expected a number"),
        (
            colour(r#"{"planck": 0}"#, ", \"D\": 1"),
            "`spectrum.planck` is no spectrum: expected a temperature in kelvin",
        ),
        (colour(r#"{"sampled": 1}"#, ", \"D\": 1"), "`spectrum.sampled` is 1.0: expected a list of samples"),
        (colour(r#"{"sampled": []}"#, ", \"D\": 1"), "`spectrum.sampled` is no spectrum: expected at least one sample"),
        (colour(r#"{"sampled": [[500]]}"#, ", \"D\": 1"), "`spectrum.sampled[0]` is a list of 1: expected a sample"),
        (
            colour(r#"{"sampled": [[500, "1"]]}"#, ", \"D\": 1"),
            "`spectrum.sampled[0][1]` is the text \"1\": expected a number",
        ),
        (colour(r#"{"sampled": [[500,1],[400,1]]}"#, ", \"D\": 1"), "ascending, but sample 1 is at 400"),
        (colour(r#"{"sampled": [[500,-1]]}"#, ", \"D\": 1"), "expected values of 0 or more, but sample 0 is -1"),
        (
            colour(r#"{"rgb": [1,1]}"#, ", \"D\": 1"),
            "`spectrum.rgb` is a list of 2: expected a list of three numbers [red",
        ),
        (
            colour(r#"{"rgb": [1,-1,0]}"#, ", \"D\": 1"),
            "`spectrum.rgb` is no spectrum: expected three finite numbers of 0",
        ),
        (colour(r#"{"planck": 6500}"#, ""), "`D` is missing: expected a Doppler factor"),
        (colour(r#"{"planck": 6500}"#, ", \"D\": 0"), "`D` is 0.0: expected a Doppler factor: a number above 0"),
        (colour(r#"{"planck": 6500}"#, ", \"D\": [1]"), "`D` is a list of 1: expected a Doppler factor"),
        (
            colour(r#"{"planck": 6500}"#, ", \"D\": 1, \"beta\": 0"),
            "`beta` is unknown here: expected no other keys than ask",
        ),
        (colour(r#"{"rgb": [1,1,1]}"#, ", \"D\": 1e300"), "the answer's `xyz` is beyond the range"),
    ] {
        let sentence = refusal(line.as_bytes());
        assert!(sentence.contains(told), "{line}\n{sentence}");
    }
}

/// Keys of a worldline whose single leg has these keys.
fn leg_of(keys: &str) -> String {
    format!(r#""start": {{"position": [0,0,0], "celerity": [0,0,0]}}, "step": 1, "legs": [{{{keys}}}]"#)
}

#[test]
fn a_bad_text_is_quoted_but_not_at_full_length() {
    let long = "ä".repeat(1_000_000);
    for line in
        [format!(r#"{{"ask": "{long}"}}"#), format!(r#"{{"ask": "boost", "{long}": 0}}"#), format!(r#"{{"{long}": {{"#)]
    {
        let sentence = refusal(line.as_bytes());
        assert!(sentence.len() < 1000, "{}", sentence.len());
    }
}
