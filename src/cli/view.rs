//! `terraline view`.

use std::path::PathBuf;

use clap::Args;

use super::Stop;
use super::scene_args::SceneArgs;
use super::scene_out::SceneOut;

/// Open a window: the scan as it is produced, flown by mouse and keys.
#[derive(Debug, Args)]
#[command(after_help = "Example: terraline view flight --size 960x600\n\
                        Example: terraline view dem.tif\n\
                        Keys: H in the window, or docs/window.md")]
pub struct View {
    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    scene_out: SceneOut,

    /// Window pixels per raster pixel, in both directions.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=32))]
    scale: u32,

    /// Show this many frames and end.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    frames: Option<u32>,

    /// Write the window as it is after the last frame, drawn to its end.
    #[arg(long, value_name = "OUT.png", requires = "frames")]
    screenshot: Option<PathBuf>,

    /// Input of the frames, a word for each, as in "w w 3 / h"; docs/window.md lists the words.
    #[arg(long, value_name = "WORDS", requires = "frames", allow_hyphen_values = true)]
    keys: Option<String>,
}

#[cfg(not(feature = "window"))]
impl View {
    pub fn run(&self) -> Result<(), Stop> {
        let Self { scene: _, scene_out: _, scale: _, frames: _, screenshot: _, keys: _ } = self;
        Err(Stop::BadInput(
            "view: this program was built without its window (feature `window`); build it with \
             that feature, or use `terraline render -o frame.png` to draw into a file"
                .into(),
        ))
    }
}

#[cfg(feature = "window")]
mod open {
    use super::super::outputs::{self, Named};
    use super::super::report;
    use super::super::scene_args::Planned;
    use super::{Stop, View};
    use crate::engine::Engine;
    use crate::scene::Scene;
    use crate::scene::height_map::Georeference;
    use crate::sink::png;
    use crate::view::layout::Layout;
    use crate::view::order::MAX_PIXELS;
    use crate::view::run;
    use crate::view::script;
    use crate::view::session::Session;
    use crate::view::window::{Screen, Window};
    use crate::view::worker::RenderWorker;

    /// Largest window that opens unasked, on a screen that has so many pixels: scenes with a larger
    /// raster get a coarser one.
    const UNASKED: (u32, u32) = (1280, 1024);

    impl View {
        pub fn run(&self) -> Result<(), Stop> {
            let script = script::parse(self.keys.as_deref().unwrap_or_default())
                .map_err(|reason| Stop::BadInput(format!("--keys: {reason}")))?;
            let frames = self.frames.unwrap_or_default();
            if script.len() > frames as usize && self.keys.is_some() {
                return Err(Stop::BadInput(format!(
                    "--keys: these words take {} frames; give --frames {0} or more",
                    script.len()
                )));
            }
            outputs::check(self.outputs())?;
            let planned = self.scene.load()?;
            outputs::keep_inputs(self.outputs(), &self.scene.inputs(&planned))?;
            outputs::check_endings(self.outputs())?;
            let scene_text = self.scene_out.text(&planned)?;
            let screen = Screen::find();
            let layout = self.layout(&planned, &screen)?;
            let map = self.map(&planned.scene);
            let engine = if planned.world.wraps() { Engine::Fast } else { Engine::Processor };
            let scene = alone(&planned);
            let title = format!("{} - terraline", scene.name);
            let mut session = Session::new(scene, planned.plan.full, map, engine, layout);
            if let Some(georeference) = self.georeference(&planned) {
                session = session.over(georeference);
            }
            let order = session.order().unwrap_or_else(|| unreachable!("the first one is new"));
            let worker = RenderWorker::start(order).map_err(|error| planned.refused(&error))?;
            let mut window =
                Window::open(&title, layout.width, layout.height).map_err(no_display)?;
            drop(screen);
            self.scene_out.write(scene_text.as_deref())?;
            for chosen in planned.framing.iter().flat_map(|framing| &framing.chosen) {
                eprintln!("chosen: {chosen}");
            }
            let mut print = |text: &str| report::print(text);
            let mut view = run::View::new(&mut window, session, worker, &mut print);
            if self.frames.is_none() {
                return Ok(view.live()?);
            }
            let canvas = view.scripted(&script, frames)?;
            if let Some(path) = &self.screenshot {
                let (width, height) = canvas.size();
                png::write(path, width, height, &canvas.bytes())?;
            }
            Ok(())
        }

        /// The files to write.
        fn outputs(&self) -> impl Iterator<Item = Named<'_>> {
            let screenshot = self.screenshot.as_deref().map(|path| ("--screenshot", path));
            screenshot.into_iter().chain(self.scene_out.named())
        }

        /// The window that shows the scene's raster, or the one asked for.
        fn layout(&self, planned: &Planned, shown: &Screen) -> Result<Layout, Stop> {
            let screen = &planned.plan.screen;
            let (mut columns, mut lines) = (screen.columns, screen.lines);
            let scale = self.scale;
            let shown = shown.size();
            if !self.scene.asks_for_size() {
                let (wide, tall) = shown.unwrap_or(UNASKED);
                let fit = |pixels: u32, most: u32| f64::from(most) / f64::from(pixels * scale);
                let across = fit(columns, wide.min(UNASKED.0));
                let share = across.min(fit(lines, tall.min(UNASKED.1))).min(1.0);
                let part = |pixels: u32| ((f64::from(pixels) * share) as u32).max(1);
                (columns, lines) = (part(columns), part(lines));
            }
            let pixels = u64::from(columns) * u64::from(lines) * u64::from(scale).pow(2);
            if pixels > MAX_PIXELS as u64 {
                return Err(Stop::BadInput(format!(
                    "--size: a window of {} x {} is too large; give a raster and a scale of at \
                     most {MAX_PIXELS} window pixels in all",
                    columns * scale,
                    lines * scale
                )));
            }
            let side = |pixels: u32| (pixels * scale) as usize;
            if let Some((wide, tall)) = shown
                && (columns * scale > wide || lines * scale > tall)
            {
                eprintln!(
                    "note: the screen has {wide}x{tall} pixels, the window asked for {}x{}: parts of \
                     it will not be seen",
                    columns * scale,
                    lines * scale
                );
            }
            Ok(Layout::new(side(columns), side(lines), scale as usize))
        }

        /// Where the map lies, if the scene was chosen for a height file and still shows that file.
        fn georeference(&self, planned: &Planned) -> Option<Georeference> {
            let (framing, terrain) = (planned.framing.as_ref()?, planned.scene.terrain()?);
            let shown = self.scene.folder().join(&terrain.source.file);
            self.scene.is(&shown).then(|| framing.georeference.clone())
        }

        /// The scene's height map as a path that holds from any folder; `None` if it is no text.
        fn map(&self, scene: &Scene) -> Option<String> {
            let Some(terrain) = scene.terrain() else { return Some(String::new()) };
            let file = self.scene.folder().join(&terrain.source.file);
            std::fs::canonicalize(&file).unwrap_or(file).to_str().map(str::to_owned)
        }
    }

    /// The scene with the chosen screen as its first: what is copied out renders as it is seen.
    fn alone(planned: &Planned) -> Scene {
        let mut scene = planned.scene.clone();
        let chosen = planned.plan.screen.name.as_str();
        if let Some(at) = scene.screens.iter().position(|screen| screen.name == chosen) {
            scene.screens[..=at].rotate_right(1);
        }
        scene
    }

    fn no_display(reason: String) -> Stop {
        let display = match std::env::var("DISPLAY") {
            Ok(name) if !name.is_empty() => format!("no window opens on display `{name}`"),
            _ => "there is no display (DISPLAY is not set)".into(),
        };
        Stop::BadInput(format!(
            "view: {display}: {reason}; start it where windows open, or use `terraline render -o \
             frame.png` to draw into a file"
        ))
    }
}
