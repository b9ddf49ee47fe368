//! Built-in scenes, random ones, and random formats of their registers.

use std::sync::Mutex;

use proptest::collection::vec;
use proptest::test_runner::TestCaseError;
use terraline::frame::Hit;
use terraline::plan::Plan;
use terraline::scene::{FormatRequest, Scene, WordSize};
use terraline::word::{Class, Overflow, Registers, Rounding};

use crate::compared::{Compared, Draw};
use crate::formats::requests;
use crate::frames::{count, difference, runner};
use crate::recipe::recipes;
use crate::scenes::{SCENES, builtin};

/// The built-in scenes, and a frame of more than a few bands of lines.
pub fn built_in_scenes(candidate: &Draw) {
    let mut compared = Compared::default();
    for name in SCENES {
        compared.in_both_words(name, &builtin(name, 160, 120), candidate);
    }
    compared.in_both_words("flight", &builtin("flight", 512, 512), candidate);
    assert_eq!(compared.frames, 10, "every scene in both word sizes");
    compared.finish(250_000);
}

/// Random scenes in both word sizes; every outcome is among their pixels.
pub fn scenes(candidate: &Draw) {
    let (seen, outcomes) = (Mutex::new(Compared::default()), Mutex::new([0; 4]));
    let result = runner(250).run(&recipes(), |recipe| {
        let mut scene = recipe.scene();
        let mut compared = seen.lock().expect("one thread");
        for words in [WordSize::Narrow, WordSize::Wide] {
            scene.machine.words = words;
            // Narrow words that cannot be proved are no refusal of the scene.
            if words == WordSize::Narrow && Plan::new(&scene, None, false).is_err() {
                continue;
            }
            if let Some(frame) = compared.scene("a random scene", &scene, false, candidate) {
                let all = [Hit::Surface, Hit::Side, Hit::Sky, Hit::OutOfRange];
                let mut outcomes = outcomes.lock().expect("one thread");
                outcomes.iter_mut().zip(all).for_each(|(n, hit)| *n += count(&frame, hit));
            }
        }
        compared.wrong().map_or(Ok(()), |wrong| Err(TestCaseError::fail(wrong)))
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    let (compared, outcomes) = (seen.into_inner(), outcomes.into_inner());
    let (compared, outcomes) = (compared.expect("no panic"), outcomes.expect("no panic"));
    println!("{outcomes:?}");
    assert!(compared.refused.len() * 10 < compared.frames, "too many scenes are refused");
    assert!(compared.frames > 375, "too few scenes in narrow words");
    assert!(outcomes.iter().all(|&pixels| pixels > 250), "an outcome is missing: {outcomes:?}");
    compared.finish(50 * 250);
}

/// Formats of a scene's own that wrap: of the built-in scenes, and random ones of random scenes.
pub fn sweeps(candidate: &Draw) {
    let mut compared = Compared::default();
    let formats = [
        (Class::Ground, 24, 8, Rounding::Nearest),
        (Class::Ground, 40, 12, Rounding::Nearest),
        (Class::Height, 26, 6, Rounding::TowardZero),
        (Class::Weight, 9, 5, Rounding::NearestEven),
        (Class::View, 14, 12, Rounding::Nearest),
        (Class::Tone, 16, 4, Rounding::Stochastic),
    ];
    for name in SCENES {
        let whole = compared.scene(name, &builtin(name, 40, 30), false, candidate);
        for (class, width, point, rounding) in formats {
            let request = FormatRequest { width, point, rounding, overflow: Overflow::Wrap };
            let formats = vec![(Registers::Class(class), request)];
            let scene = Scene { formats, ..builtin(name, 40, 30) };
            let what = format!("{name}, {class:?}");
            let frame = compared.scene(&what, &scene, false, candidate);
            // What was made coarse is coarse: the frame is another one.
            if let (Class::View | Class::Ground, Some(whole), Some(frame)) = (class, &whole, frame)
            {
                assert!(difference(whole, &frame).is_some(), "{what}");
            }
        }
    }
    compared.finish(10_000);

    let seen = Mutex::new(Compared::default());
    let strategy = (recipes(), vec(requests(), 1..=3));
    let result = runner(120).run(&strategy, |(recipe, formats)| {
        let scene = Scene { formats, ..recipe.scene() };
        let mut compared = seen.lock().expect("one thread");
        // Coarse registers may put the eye under the ground or not hold the map at all.
        compared.scene("a random scene", &scene, false, candidate);
        compared.wrong().map_or(Ok(()), |wrong| Err(TestCaseError::fail(wrong)))
    });
    result.unwrap_or_else(|error| panic!("{error}"));
    let compared = seen.into_inner().expect("no panic");
    assert!(compared.frames > compared.refused.len(), "too many sweeps are refused");
    compared.finish(5_000);
}
