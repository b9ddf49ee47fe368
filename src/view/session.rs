//! What is being looked at and how. Actions change it; nothing here draws or waits.

mod flight;
mod looks;
mod orbit;

use std::sync::Arc;

use glam::DVec3;

use crate::engine::Engine;
use crate::scene::{Camera, Deformation, Scene, Screen, write};
use crate::scene::height_map::Georeference;
use crate::sink::picture::Picture;
use crate::sink::picture::errors::ErrorPart;

use super::action::{Action, Effect, Side};
use super::camera;
use super::layout::Layout;
use super::measure::Measure;
use super::order::Order;
use super::pace::Pace;
use super::pane::Pane;

/// The state of the window.
pub struct Session {
    scene: Arc<Scene>,
    full: bool,
    map: Option<String>,
    georeference: Option<Georeference>,
    first: (Camera, Screen),
    panes: [Pane; 2],
    split: Option<f64>,
    /// Pixels at the bright end of errors, if keys have chosen, and what is on the screen.
    error_high: Option<f64>,
    shown_high: Option<f64>,
    /// Of deformation 2, while another one is on.
    weight_shift: u32,
    /// The ramp of the scene, and which of those to choose from is on.
    ramp: (Vec<[u8; 3]>, usize),
    pace: Pace,
    layout: Layout,
    cursor: Option<(i32, i32)>,
    /// The ground that the craft orbits around.
    pivot: Option<DVec3>,
    help: bool,
    /// Pages turned in the help, and in the status line.
    pages: [i32; 2],
    panels: bool,
    notice: Option<String>,
    changed: bool,
}

/// Pixels that the bright end of errors may stand for.
const ERROR_RANGE: (f64, f64) = (1.0 / 1_073_741_824.0, 1024.0);

/// Why a scene cannot be copied out.
const NO_PATH: &str =
    "no scene file can name this map, its path is not UTF-8 text: rename its folder";

impl Session {
    /// A scene whose first screen is looked at. `map` is the path of its height map for scenes
    /// that are copied out; without it none can be.
    #[must_use]
    pub fn new(
        scene: Scene,
        full: bool,
        map: Option<String>,
        engine: Engine,
        layout: Layout,
    ) -> Self {
        let pane = Pane { engine, picture: Picture::Color, part: ErrorPart::Total };
        let right = Pane { picture: Picture::Steps, ..pane };
        let mut session = Self {
            first: (scene.camera.clone(), scene.screens[0].clone()),
            weight_shift: match scene.kernel.deformation {
                Deformation::TowardHat { weight_shift } => weight_shift,
                _ => 2,
            },
            ramp: (scene.color.ramp.clone(), 0),
            scene: Arc::new(scene),
            full,
            map,
            georeference: None,
            panes: [pane, right],
            split: None,
            error_high: None,
            shown_high: None,
            pace: Pace::default(),
            layout,
            cursor: None,
            pivot: None,
            help: false,
            pages: [0; 2],
            panels: true,
            notice: None,
            changed: true,
        };
        session.resize(layout);
        session
    }

    /// The same, over the map of a file that says where it lies.
    #[must_use]
    pub fn over(self, georeference: Georeference) -> Self {
        Self { georeference: Some(georeference), ..self }
    }

    /// What its lengths and places are outside of the scene.
    #[must_use]
    pub fn measure(&self) -> Measure<'_> {
        Measure::new(&self.scene, self.georeference.as_ref())
    }

    /// The scene as it is now.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Where the raster lies in the window.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// The panes that are seen, left first.
    #[must_use]
    pub fn panes(&self) -> &[Pane] {
        &self.panes[..1 + usize::from(self.split.is_some())]
    }

    /// Place of the split across the raster, 0..=1.
    #[must_use]
    pub fn split(&self) -> Option<f64> {
        self.split
    }

    /// Pace of the scan.
    #[must_use]
    pub fn pace(&self) -> Pace {
        self.pace
    }

    /// Whether the keys are shown.
    #[must_use]
    pub fn shows_help(&self) -> bool {
        self.help
    }

    /// Pages that were turned in the help, forth less back.
    #[must_use]
    pub fn help_page(&self) -> i32 {
        self.pages[0]
    }

    /// Pages that were turned in the status line, forth less back.
    #[must_use]
    pub fn status_page(&self) -> i32 {
        self.pages[1]
    }

    /// Whether legends and status are shown.
    #[must_use]
    pub fn shows_panels(&self) -> bool {
        self.panels
    }

    /// What the last action has to say.
    #[must_use]
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }

    /// Says something until the next action.
    pub fn tell(&mut self, notice: String) {
        self.notice = Some(notice);
    }

    /// Takes note of the errors at the bright end of their ramp, as the screen has them.
    pub fn see_errors(&mut self, high: Option<f64>) {
        self.shown_high = high;
    }

    /// The raster pixel (column, line) under the cursor.
    #[must_use]
    pub fn pointed(&self) -> Option<(u32, u32)> {
        let (x, y) = self.cursor?;
        self.layout.pixel(x, y)
    }

    /// What is to be drawn, if that is something else than at the last call.
    pub fn order(&mut self) -> Option<Order> {
        std::mem::take(&mut self.changed).then(|| Order {
            scene: Arc::clone(&self.scene),
            full: self.full,
            panes: self.panes().to_vec(),
            error_high: self.error_high,
            by_lines: !self.pace.is_full(),
        })
    }

    /// Takes the raster of another window.
    pub fn resize(&mut self, layout: Layout) {
        self.layout = layout;
        let screen = &self.scene.screens[0];
        let (columns, lines) = (layout.columns as u32, layout.lines as u32);
        if (screen.columns, screen.lines) != (columns, lines) {
            let screen = screen.resized(columns, lines);
            self.change_scene().screens[0] = screen;
        }
    }

    /// Lines that time has earned.
    pub fn advance(&mut self, seconds: f64) -> u32 {
        self.pace.advance(seconds)
    }

    /// Changes the session; what the loop has to do as well is returned.
    pub fn act(&mut self, action: Action) -> Option<Effect> {
        if !matches!(action, Action::Point(_)) {
            self.notice = None;
        }
        match action {
            Action::Picture(side, picture) => self.set_pane(side, |pane| Pane { picture, ..pane }),
            Action::NextErrors(side) => self.set_pane(side, |pane| match pane.picture {
                Picture::Error => pane.next_part(),
                _ => Pane { picture: Picture::Error, ..pane },
            }),
            Action::ErrorRange(steps) => {
                let now = self.error_high.or(self.shown_high).unwrap_or(1.0);
                let (least, most) = ERROR_RANGE;
                self.error_high = Some((now * 4.0_f64.powi(steps)).clamp(least, most));
                self.changed = true;
            }
            Action::FreeErrorRange => {
                self.error_high = None;
                self.changed = true;
            }
            Action::NextEngine(side) => self.set_pane(side, Pane::next_engine),
            Action::NextShape => self.next_shape(),
            Action::NextDeformation => self.next_deformation(),
            Action::Weight(step) => self.add_weight(step),
            Action::Exaggerate(steps) => self.exaggerate(steps),
            Action::TurnSun(east, up) => self.turn_sun(east, up),
            Action::NextRamp(steps) => self.next_ramp(steps),
            Action::ToggleSplit => {
                self.split = if self.split.is_some() { None } else { Some(0.5) };
                self.changed = true;
            }
            Action::MoveSplit(place) => {
                self.split = self.split.map(|_| place.clamp(0.0, 1.0));
            }
            Action::TogglePause => self.set_pace(Pace::toggle_pause),
            Action::Faster => self.set_pace(Pace::faster),
            Action::Slower => self.set_pace(Pace::slower),
            Action::OneLine => {
                self.set_pace(Pace::pause);
                return Some(Effect::Line);
            }
            Action::ToggleHelp => {
                self.help = !self.help;
                self.pages[0] = 0;
            }
            Action::Page(count) => {
                let page = &mut self.pages[usize::from(!self.help)];
                *page = page.wrapping_add(count);
            }
            Action::TogglePanels => self.panels = !self.panels,
            Action::Reset => self.reset(),
            Action::FrameMap => self.frame_map(),
            Action::Drag(right, down) => {
                let degrees =
                    camera::degrees_per_pixel(&self.scene.screens[0]) / self.layout.scale as f64;
                self.fly(|craft, _| camera::turn(craft, right * degrees, down * degrees, 0.0));
            }
            Action::Turn(heading, pitch, roll) => {
                self.fly(|craft, _| camera::turn(craft, heading, pitch, roll));
            }
            Action::Zoom(notches) => camera::zoom(&mut self.change_scene().screens[0], notches),
            Action::Dolly(notches) => self.dolly(notches),
            Action::HoldGround => self.hold_ground(),
            Action::Orbit(right, down) => self.orbit(right, down),
            Action::Approach(notches) => self.approach(notches),
            Action::Fly(course, seconds) => {
                let distance = self.speed() * seconds;
                self.fly(|craft, grain| camera::fly(craft, course, distance, grain));
            }
            Action::Point(place) => self.cursor = place,
            Action::Explain(x, y) => {
                let (column, line) = self.layout.pixel(x, y)?;
                self.notice = Some(format!("pixel {column},{line} explained in the terminal"));
                return Some(Effect::Explain(column, line));
            }
            Action::Screenshot => return Some(Effect::Screenshot),
            Action::CopyScene => {
                let Some(map) = &self.map else {
                    self.notice = Some(NO_PATH.into());
                    return None;
                };
                self.notice = Some("the scene is printed in the terminal".into());
                return Some(Effect::Print(write::toml(&self.scene, map)));
            }
            Action::Quit => return Some(Effect::Quit),
        }
        None
    }

    /// The scene, to change it: what was drawn of it is then of no use.
    fn change_scene(&mut self) -> &mut Scene {
        self.changed = true;
        Arc::make_mut(&mut self.scene)
    }

    fn set_pane(&mut self, side: Side, change: impl FnOnce(Pane) -> Pane) {
        if side == Side::Right && self.split.is_none() {
            self.split = Some(0.5);
        }
        let pane = &mut self.panes[usize::from(side == Side::Right)];
        *pane = change(*pane);
        self.changed = true;
    }

    fn set_pace(&mut self, change: impl FnOnce(&mut Pace)) {
        let before = self.pace.is_full();
        change(&mut self.pace);
        // Between two speeds the scan goes on where it is.
        self.changed |= before != self.pace.is_full();
    }
}
