//! Law: a tour rides where it says by samples that pass through the real decoders, stops where it asks, goes on from
//! there, and ends. A wrong program would leave the route, lose the tour at a pause, or run on while somebody reads.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, too, may fail the test")]

use built_in::{dice, town};
use glam::DVec3;
use input::{Action, DeskConfig, KeyboardKey, Nanos, SECOND, Sample, SampleSource, Setting, Switch};
use ride::{LightSpeed, RideFrame, Simulation};
use scene::collision::Collision;
use scene::{OpenPlane, Scene, Surroundings};
use std::sync::{Arc, OnceLock};
use tours::{TourChange, TourPanel, TourPlan, TourPlayer, TourView, built_in, parse};
use view::Effects;

const FRAMES_PER_SECOND: u64 = 60;

/// Ride of a tour, frame by frame.
struct Ridden {
    player: TourPlayer,
    ride: Simulation,
    frame: u64,
    changes: Vec<TourChange>,
    last: Option<RideFrame>,
}

impl Ridden {
    fn new(plan: TourPlan, scene: &Scene, surroundings: Arc<dyn Surroundings>) -> Self {
        let desk = DeskConfig::default();
        let usual = scene.speed_of_light_m_s.unwrap_or(30.0 / 3.6);
        let light_speed = LightSpeed::new(plan.speed_of_light_m_s.unwrap_or(usual)).unwrap();
        let setup = plan.setup(&scene.start, light_speed, desk.clone());
        let player = TourPlayer::new(Arc::new(plan), &scene.circuit, &desk).unwrap();
        let ride = Simulation::new(setup, surroundings).unwrap();
        Self { player, ride, frame: 0, changes: Vec::new(), last: None }
    }

    fn now(&self) -> Nanos {
        self.frame * SECOND / FRAMES_PER_SECOND
    }

    /// One frame later.
    fn go(&mut self) -> &RideFrame {
        let now = self.now();
        let step = self.player.step(now, &self.ride);
        self.changes.extend(step.changes);
        self.last = Some(self.ride.frame(now, &step.samples));
        self.frame += 1;
        self.last.as_ref().unwrap()
    }

    /// So many frames later.
    fn run(&mut self, frames: u32) {
        for _ in 0..frames {
            self.go();
        }
    }

    /// Goes on until the tour waits or is over; answers and goes on again. Returns the number of times it waited.
    fn end(&mut self) -> usize {
        let mut waited = 0;
        for _ in 0..FRAMES_PER_SECOND * 90 {
            self.go();
            if self.player.is_over() {
                return waited;
            }
            if self.player.is_waiting() {
                waited += 1;
                // The pause takes effect at the next tick.
                self.go();
                let held = self.position();
                for _ in 0..30 {
                    self.go();
                }
                assert_eq!(self.position(), held, "the ride moves while the tour waits");
                assert!(self.player.is_waiting());
                self.player.answer(0);
                self.player.go_on();
            }
        }
        panic!("the tour does not end, at station {}", self.player.station());
    }

    fn position(&self) -> DVec3 {
        DVec3::from_array(self.last.as_ref().unwrap().record.position)
    }
}

fn old_town() -> (&'static Scene, Arc<Collision>) {
    static TOWN: OnceLock<(Scene, Arc<Collision>)> = OnceLock::new();
    let (scene, collision) = TOWN.get_or_init(|| {
        let scene = town::build(town::TOWN_SEED);
        let collision = Arc::new(Collision::new(&scene).unwrap());
        (scene, collision)
    });
    (scene, Arc::clone(collision))
}

#[test]
fn the_tour_of_the_town_follows_its_street_and_brings_the_effects_one_at_a_time() {
    let (scene, collision) = old_town();
    let mut ridden = Ridden::new(built_in("searchlight").unwrap(), scene, collision);
    assert_eq!(ridden.end(), 1);
    let off = scene.circuit.windows(2).map(|pair| {
        let along =
            ((ridden.position() - pair[0]).dot(pair[1] - pair[0]) / pair[0].distance_squared(pair[1])).clamp(0.0, 1.0);
        (ridden.position() - pair[0].lerp(pair[1], along)).with_y(0.0).length()
    });
    assert!(off.fold(f64::INFINITY, f64::min) < 1.0, "{} is off the street", ridden.position());
    let way = ridden.last.as_ref().unwrap().record.odometer;
    assert!(ridden.position().distance(scene.start.position) > 40.0, "{way} m");
    let effects: Vec<String> = ridden
        .changes
        .iter()
        .filter_map(|change| match change {
            TourChange::Effects(effects) => Some(effects.to_string()),
            _ => None,
        })
        .collect();
    assert_eq!(effects, ["none", "geometry", "geometry,doppler", "geometry,doppler,searchlight"]);
}

#[test]
fn the_tour_of_the_dice_is_fast_while_it_shows_what_is_seen_and_what_is_measured() {
    let scene = dice::build();
    let mut ridden = Ridden::new(built_in("terrell").unwrap(), &scene, Arc::new(Collision::new(&scene).unwrap()));
    while ridden.player.station() < 4 {
        ridden.go();
    }
    assert!(ridden.changes.contains(&TourChange::View(TourView::Measured)));
    let frame = ridden.last.as_ref().unwrap();
    let celerity = DVec3::from_array(frame.record.celerity).length();
    assert!(celerity > 1.0, "{celerity}");
    let beside = ridden.position().z;
    assert!((-100.0..-40.0).contains(&beside), "{beside}");
    ridden.end();
    // Still on the road, beside the last dice or just behind them.
    let end = ridden.position();
    assert!(end.x.abs() < 0.5 && (-180.0..-80.0).contains(&end.z), "{end}");
}

#[test]
fn the_traveller_comes_back_to_the_gate_younger() {
    let (scene, _) = old_town();
    let plan = built_in("twins").unwrap();
    let [start, _] = plan.start.unwrap();
    let mut ridden = Ridden::new(plan, scene, Arc::new(OpenPlane));
    let mut farthest = 0.0_f64;
    while !ridden.player.is_waiting() {
        ridden.go();
        farthest = farthest.max(ridden.position().distance(start));
    }
    let record = ridden.last.as_ref().unwrap().record.clone();
    assert!((15.0..19.0).contains(&farthest), "{farthest}");
    assert!(ridden.position().distance(start) < 1.0, "{} from {start}", ridden.position());
    let celerity = DVec3::from_array(record.celerity).length();
    assert!(celerity < 0.08, "{celerity}");
    // Four pieces of about 4 s at 0.4 rapidity a second: 4 sinh 1.6 / 0.4 = 23.8 s of the town for 16 s of the
    // traveller.
    let (town_s, own_s) = (record.ct / 2.0, record.proper_time / 2.0);
    assert!(town_s - own_s > 5.0, "{town_s} {own_s}");
}

#[test]
fn the_tour_of_slow_light_speeds_up_waits_and_brakes() {
    let (scene, collision) = old_town();
    let mut ridden = Ridden::new(built_in("slow-light").unwrap(), scene, collision);
    while !ridden.player.is_waiting() {
        ridden.go();
    }
    let fast = DVec3::from_array(ridden.last.as_ref().unwrap().record.celerity).length();
    assert!(fast > 0.9, "{fast}");
    assert_eq!(ridden.end(), 2);
    let slow = DVec3::from_array(ridden.last.as_ref().unwrap().record.celerity).length();
    assert!(slow < 0.2, "{slow}");
}

#[test]
fn a_tour_that_is_stopped_goes_on_where_it_was() {
    let text = "title.en = \"A\"\nscene = \"dice\"\nroute = [[0, 0, 10], [0, 0, -200]]\ngain = 3\n\
                [[station]]\nseconds = 6\nspeed = \"20 km/h\"\neffects = \"geometry\"\n[[station]]\nseconds = 3\n";
    let scene = Scene { speed_of_light_m_s: Some(30.0 / 3.6), ..dice::build() };
    let ride = |stops: bool| {
        let mut ridden = Ridden::new(parse("a.toml", text).unwrap(), &scene, Arc::new(OpenPlane));
        for frame in 0..FRAMES_PER_SECOND * 30 {
            if stops && frame == FRAMES_PER_SECOND * 4 {
                ridden.player.stop();
                let held = {
                    ridden.go();
                    ridden.go();
                    ridden.position()
                };
                for _ in 0..FRAMES_PER_SECOND * 7 {
                    ridden.go();
                }
                assert_eq!(ridden.position(), held);
                ridden.player.go_on();
            }
            ridden.go();
            if ridden.player.is_over() {
                return (ridden.position(), ridden.player.own_s());
            }
        }
        panic!("the tour does not end");
    };
    let (through, stopped) = (ride(false), ride(true));
    assert!((through.1 - stopped.1).abs() < 0.1, "{} {}", through.1, stopped.1);
    assert!(through.0.distance(stopped.0) < 2.0, "{} {}", through.0, stopped.0);
}

#[test]
fn a_tour_repeats_to_the_bit() {
    let scene = dice::build();
    let ride = || {
        let mut ridden = Ridden::new(built_in("terrell").unwrap(), &scene, Arc::new(OpenPlane));
        ridden.end();
        ridden.position().to_array().map(f64::to_bits)
    };
    assert_eq!(ride(), ride());
}

#[test]
fn a_question_stays_open_until_it_is_answered() {
    let scene = dice::build();
    let mut ridden = Ridden::new(built_in("terrell").unwrap(), &scene, Arc::new(OpenPlane));
    while !ridden.player.is_waiting() {
        ridden.go();
    }
    ridden.player.go_on();
    ridden.player.answer(17);
    ridden.go();
    assert!(ridden.player.question().is_some() && ridden.player.answered().is_none());
    ridden.player.answer(1);
    assert!(ridden.player.answered().unwrap().right);
    ridden.player.go_on();
    ridden.go();
    assert!(ridden.player.is_over() && ridden.player.question().is_none());
    let first = ridden.changes.first();
    assert_eq!(first, Some(&TourChange::Effects(Effects::GEOMETRY)));
}

#[test]
fn changes_are_actions_that_hold_whatever_is_shown() {
    let set = |setting, text: &str| vec![Action::Set(setting, text.to_owned())];
    assert_eq!(TourChange::Effects(Effects::GEOMETRY).actions(), set(Setting::Effects, "geometry"));
    assert_eq!(TourChange::View(TourView::Measured).actions(), set(Setting::View, "measured"));
    let turned = TourChange::Show(vec![TourPanel::Diagram, TourPanel::Clocks]).actions();
    let on = |switch, on| Action::Turn(switch, on);
    let of_vehicle = on(Switch::DiagramOfVehicle, false);
    let expected = [on(Switch::Diagram, true), of_vehicle, on(Switch::Miniature, false), on(Switch::Clocks, true)];
    assert_eq!(turned, expected);
}

/// Ride of the twins to its first question, whose visitor does `meddle` in every frame. Returns the distance from the
/// gate, and the own time.
fn twins(frames_per_second: u64, mut meddle: impl FnMut(u64, Nanos) -> Vec<Sample>) -> (f64, f64) {
    let (scene, _) = old_town();
    let plan = built_in("twins").unwrap();
    let [start, _] = plan.start.unwrap();
    let mut ridden = Ridden::new(plan, scene, Arc::new(OpenPlane));
    for frame in 0..frames_per_second * 120 {
        let now = frame * SECOND / frames_per_second;
        let mut samples = meddle(frame, now);
        samples.extend(ridden.player.step(now, &ridden.ride).samples);
        samples.sort_by_key(|sample| sample.at);
        ridden.last = Some(ridden.ride.frame(now, &samples));
        if ridden.player.question().is_some() {
            return (ridden.position().distance(start), ridden.player.own_s());
        }
    }
    panic!("the twins do not come back");
}

#[test]
fn the_traveller_comes_back_whatever_the_visitor_does_and_however_late_frames_come() {
    let quiet = twins(60, |_, _| Vec::new());
    assert!(quiet.0 < 0.1, "{quiet:?}");
    let act = |now, action: Action| vec![Sample::action(now, &action)];
    // Held by the visitor for a while, in the middle of a station.
    let held = twins(60, |frame, now| match frame {
        200 | 500 => act(now, Action::TogglePause),
        _ => Vec::new(),
    });
    // The window loses its focus, and the visitor plays with a key.
    let meddled = twins(60, |frame, now| match frame % 97 {
        13 => vec![Sample::closed(now, SampleSource::Keyboard)],
        40 => vec![Sample::key(now, KeyboardKey::W, true)],
        41 => vec![Sample::key(now, KeyboardKey::W, false)],
        _ => Vec::new(),
    });
    let slow_clock = twins(60, |frame, now| if frame == 0 { act(now, Action::TimeScale(0.5)) } else { Vec::new() });
    let slow_frames = twins(7, |_, _| Vec::new());
    for (name, ridden) in [("held", held), ("clock", slow_clock), ("frames", slow_frames)] {
        assert!((ridden.0 - quiet.0).abs() < 0.2 && (ridden.1 - quiet.1).abs() < 0.02, "{name}: {ridden:?} {quiet:?}");
    }
    assert!(meddled.0 < 1.5, "{meddled:?}");
}

#[test]
fn a_visitor_who_holds_the_ride_holds_the_tour_and_cannot_turn_its_pauses_round() {
    let scene = dice::build();
    let mut ridden = Ridden::new(built_in("terrell").unwrap(), &scene, Arc::new(OpenPlane));
    let toggle = |ridden: &mut Ridden| {
        let now = ridden.now();
        let mut samples = ridden.player.step(now, &ridden.ride).samples;
        samples.push(Sample::action(now, &Action::TogglePause));
        ridden.last = Some(ridden.ride.frame(now, &samples));
        ridden.frame += 1;
    };
    ridden.run(100);
    toggle(&mut ridden);
    ridden.go();
    let (own_s, place) = (ridden.player.own_s(), ridden.position());
    ridden.run(600);
    assert_eq!((ridden.player.own_s(), ridden.position(), ridden.player.is_waiting()), (own_s, place, false));
    toggle(&mut ridden);
    while !ridden.player.is_waiting() {
        ridden.go();
    }
    ridden.go();
    let place = ridden.position();
    // Whoever lets the ride go while the tour asks is held again at once.
    toggle(&mut ridden);
    ridden.run(60);
    assert!(ridden.position().distance(place) < 1.0, "{} {place}", ridden.position());
}

#[test]
fn the_bells_strike_at_once_for_the_platform_and_one_after_the_other_for_the_rider() {
    let scene = built_in::train::build();
    let mut ridden = Ridden::new(built_in("bells").unwrap(), &scene, Arc::new(Collision::new(&scene).unwrap()));
    let (mut bells, mut middle_ct, mut seen) = (Vec::new(), f64::NAN, Vec::new());
    while ridden.player.question().is_none() {
        let ct = ridden.ride.vehicle().state().ct;
        let known = ridden.changes.len();
        ridden.go();
        for change in &ridden.changes[known..] {
            if let TourChange::Mark(event) = change {
                bells.push((event.position, ct + 30.0 * event.after_s));
            }
        }
        let frame = ridden.last.as_ref().unwrap();
        let eye = frame.gaze.observer.event;
        if middle_ct.is_nan() && eye.position.x >= 0.0 {
            middle_ct = eye.ct;
        }
        for (number, (position, bell_ct)) in bells.iter().enumerate() {
            if !seen.contains(&number) && eye.ct - bell_ct >= position.distance(eye.position) {
                seen.push(number);
                assert_eq!(ridden.player.station(), [2, 3][number], "the caption tells what is seen");
            }
        }
    }
    let [(ahead, ct), (behind, same)] = bells[..] else { panic!("{bells:?}") };
    assert!(ct == same && ahead.x == -behind.x && seen == [0, 1], "{bells:?} {seen:?}");
    // They strike as the rider passes the middle, to a metre.
    assert!((ct - middle_ct).abs() < 1.5, "{ct} {middle_ct}");
    // t' = γ (t − β x): the one ahead is earlier by 2 γ β · 54 m of light travel.
    let observer = ridden.last.as_ref().unwrap().gaze.observer;
    let (gamma, beta) = (observer.celerity.gamma(), observer.celerity.beta().vector().x);
    assert!((0.65..0.75).contains(&beta), "{beta}");
    let own = |place: DVec3| gamma * (ct - beta * place.x);
    assert!(own(behind) - own(ahead) > 100.0 * gamma * beta);
}
