//! Film of a tour: its ride, with the captions in the pictures. Where the tour waits for a visitor, the film shows the
//! text for as long as it takes to read it, and gives the right answer.

use crate::commands::cameraman::{Cameraman, Equipment, FilmOut, dial_of_stills};
use crate::commands::film_titles::FilmTitles;
use crate::error::Error;
use crate::output::say::tell;
use crate::session::reel::{FRAMES_PER_SECOND, Told};
use crate::session::start::{RideRoom, first_actions};
use crate::session::waiting::{self, ReadyTour};
use command::RideOptions;
use filming::Reel;
use input::{Action, Nanos, SECOND, Sample};
use interface::{Caption, CaptionQuestion};
use picture_files::FilmCodec;
use render::Gpu;
use std::path::Path;

/// Longest film of a tour, seconds.
const LONGEST_S: f64 = 900.0;
/// Time for finding a text, seconds, and speed of reading, characters a second.
const FINDING_S: f64 = 2.0;
const READING: f64 = 18.0;

/// Films a tour into `path`.
///
/// # Errors
/// Any fault that keeps the tour from being ridden or drawn.
pub fn film(gpu: &Gpu, options: &RideOptions, name: &str, path: &Path) -> Result<(), Error> {
    let plan = waiting::plan(name)?;
    if plan.recording.is_some() {
        return Err(Error::TourOfRecording);
    }
    let room = RideRoom::of(options)?;
    let ReadyTour { options, scene, presentation, mut simulation, mut log, mut tour } =
        ReadyTour::of(options, &room, name, plan)?;
    let rate = f64::from(FRAMES_PER_SECOND);
    let mut reel = Reel::new(rate, options.seconds.unwrap_or(LONGEST_S).min(LONGEST_S), presentation);
    let mut since: Option<(Caption, Nanos)> = None;
    loop {
        let at = reel.due();
        let caption = tour.caption(presentation.language);
        match caption.as_ref().filter(|caption| caption.waits) {
            None => since = None,
            Some(shown) => {
                let began = since.as_ref().filter(|(before, _)| before == shown).map_or(at, |(_, began)| *began);
                since = Some((shown.clone(), began));
                if (at - began) as f64 >= reading_s(shown) * SECOND as f64 {
                    tour.act(&tour.right_answer().unwrap_or(Action::GoOn));
                }
            }
        }
        let mut samples = tour.samples(at, &simulation);
        if at == 0 {
            samples.extend(first_actions(&options).iter().map(|action| Sample::action(0, action)));
        }
        let frame = simulation.frame(at, &samples);
        if let Err(error) = log.frame(&samples, &frame) {
            tell(error);
        }
        let caption = tour.caption(presentation.language);
        let is_over = caption.is_none();
        let marks = tour.take_marks();
        let told = |shown: &_| Some(Told { frame: frame.clone(), presentation: *shown, caption, marks });
        if !reel.add_told(&frame, told) || is_over {
            break;
        }
    }
    let recorded = log.finish();
    let titles = FilmTitles::new(gpu, &scene, options.picture.size);
    let dial = dial_of_stills(&options.dial, &options.picture);
    let mut camera = Cameraman::new(gpu, scene, &options.picture, dial, Equipment::default())?.with_titles(titles);
    let count = reel.len();
    camera.film((0..).zip(reel.pictures()).map(Ok), count, FilmOut::Film(path, FilmCodec::usual(path), rate))?;
    Ok(recorded?)
}

/// Time that it takes to read what a waiting tour shows last, seconds.
fn reading_s(caption: &Caption) -> f64 {
    let text = match &caption.question {
        None => caption.text.len(),
        Some(CaptionQuestion { chosen: Some(chosen), .. }) => chosen.why.len(),
        Some(CaptionQuestion { ask, answers, .. }) => ask.len() + answers.iter().map(String::len).sum::<usize>(),
    };
    FINDING_S + text as f64 / READING
}
