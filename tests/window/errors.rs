//! Pictures of errors.

use terraline::engine::Engine;
use terraline::sink::picture::Picture;
use terraline::sink::picture::errors::{ErrorPart, ErrorView};
use terraline::study::error::Sample;
use terraline::view::action::{Action, Side};
use terraline::view::layout::Layout;
use terraline::view::session::Session;
use terraline::view::worker::RenderWorker;

use super::{scene, support};

#[test]
fn parts_of_errors_are_shown_in_turn_in_a_range_of_their_own() {
    let scene = scene("flight", &["screen.size=[80, 60]"]);
    let plan = support::plan(&scene);
    let machine = support::machine(&scene, &plan).expect("a scene that can be drawn");
    let band = machine.scan_errors(Sample::all(&plan)).expect("errors").finish();
    let of = |part, high| Picture::Error.with(&band, ErrorView { part, high }).expect("errors");

    let layout = Layout::new(80, 60, 1);
    let mut session = Session::new(scene.clone(), false, None, Engine::Fast, layout);
    let worker = RenderWorker::start(session.order().expect("an order")).expect("a worker");
    let mut shown = |action| {
        session.see_errors(worker.snapshot().error_high());
        session.act(action);
        worker.order(session.order().expect("an order"));
        worker.finish();
        let image = worker.snapshot().images[0].clone();
        (image.pixels.clone(), image.legend.expect("a legend"), image.pane.title())
    };
    let mut pictures = Vec::new();
    let parts = [ErrorPart::Total, ErrorPart::Algorithm, ErrorPart::Quantisation];
    for (part, between) in
        parts.into_iter().zip(["fixed - oracle", "real - oracle", "fixed - real"])
    {
        let (pixels, legend, title) = shown(Action::NextErrors(Side::Left));
        let expected = of(part, None);
        assert!(pixels == expected.pixels && Some(legend) == expected.legend, "{part:?}");
        assert!(title.contains(part.name()) && title.contains(between), "{title}");
        // Errors of stock words are seen: more than half of them lie inside the ramp.
        let dark = Picture::Error.ramp(0.0).expect("a ramp");
        assert!(pixels.iter().filter(|&&pixel| pixel == dark).count() < pixels.len() / 2);
        pictures.push(pixels);
    }
    assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2]);
    // A quarter of what is on the screen, four times, and free again.
    let free = of(ErrorPart::Quantisation, None).legend.expect("a legend").high;
    for (action, high) in [
        (Action::ErrorRange(-1), free / 4.0),
        (Action::ErrorRange(1), free),
        (Action::ErrorRange(1), free * 4.0),
    ] {
        let (pixels, legend, _) = shown(action);
        assert_eq!((legend.low, legend.high), (high / 1024.0, high));
        assert!(pixels == of(ErrorPart::Quantisation, Some(high)).pixels);
    }
    assert_eq!(shown(Action::FreeErrorRange).1.high, free);
    // The engine in f64 has errors of the algorithm alone.
    shown(Action::NextEngine(Side::Left));
    let (pixels, _, title) = shown(Action::NextEngine(Side::Left));
    assert!(pixels == pictures[1] && title.contains("algorithm"), "{title}");
}
