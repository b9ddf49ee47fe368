//! Keys and mouse of one tick, and what they mean.

use super::action::{Action, Side};
use super::camera::Course;
use super::layout::Layout;
use crate::sink::picture::Picture;

/// A key. Characters are those that are typed, so that they are where the keyboard has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Key {
    /// A character, capital with shift.
    Char(char),
    /// One of the digits 1 to 9 with shift, whatever character that types.
    Shifted(u8),
    /// Escape.
    Escape,
    /// Tabulator.
    Tab,
    /// Home.
    Home,
    /// Page up.
    PageUp,
    /// Page down.
    PageDown,
    /// Arrow.
    Left,
    /// Arrow.
    Right,
    /// Arrow.
    Up,
    /// Arrow.
    Down,
    /// The left arrow, if it went down with Shift.
    RollLeft,
    /// The right arrow, if it went down with Shift.
    RollRight,
}

/// What the hands do in one tick.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Input {
    /// Keys that went down, in order.
    pub pressed: Vec<Key>,
    /// Keys that are down, or were for a moment: small letters and arrows. One that acted with Shift
    /// when it went down, as S does, is not among them.
    pub held: Vec<Key>,
    /// Shift is down.
    pub shift: bool,
    /// The cursor in window pixels, also outside while a button is down; `None` where unknown.
    pub cursor: Option<(i32, i32)>,
    /// The left button is down.
    pub button: bool,
    /// The right button is down, or what stands for it.
    pub orbit: bool,
    /// Notches of the wheel, away from the hand.
    pub wheel: f64,
}

/// Window pixels from the split within which it is taken hold of.
const GRIP: i32 = 6;

/// Window pixels that a click may slip.
const SLIP: i32 = 3;

/// Degrees per second that arrow keys turn.
const TURN: f64 = 40.0;

/// Degrees by which a key turns the sun, and by which it lifts it.
const SUN: (f64, f64) = (15.0, 5.0);

/// Factor of shift on the speed of flight.
const HURRY: f64 = 4.0;

/// What a button holds.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    Nothing,
    /// The scene: since where, where last, and whether it has been moved.
    Scene {
        from: (i32, i32),
        last: (i32, i32),
        moved: bool,
    },
    Split,
    /// The ground in the middle of the screen: since where last.
    Ground {
        last: (i32, i32),
    },
}

/// Turns input into actions.
#[derive(Debug)]
pub struct Hands {
    hold: Hold,
    cursor: Option<(i32, i32)>,
}

impl Default for Hands {
    fn default() -> Self {
        Self { hold: Hold::Nothing, cursor: None }
    }
}

impl Hands {
    /// The actions of one tick of `seconds`.
    pub fn actions(
        &mut self,
        input: &Input,
        layout: &Layout,
        split: Option<f64>,
        seconds: f64,
    ) -> Vec<Action> {
        let mut actions: Vec<Action> = input
            .pressed
            .iter()
            .filter_map(|&key| match (key, input.cursor) {
                (Key::Char('x' | 'X'), Some((x, y))) => Some(Action::Explain(x, y)),
                (key, _) => of(key),
            })
            .collect();
        self.mouse(input, layout, split, &mut actions);
        actions.extend(flight(input, seconds));
        actions
    }

    fn mouse(
        &mut self,
        input: &Input,
        layout: &Layout,
        split: Option<f64>,
        actions: &mut Vec<Action>,
    ) {
        if input.cursor != self.cursor {
            self.cursor = input.cursor;
            actions.push(Action::Point(input.cursor));
        }
        if input.wheel != 0.0 {
            let wheel = input.wheel;
            actions.push(match self.hold {
                Hold::Ground { .. } => Action::Approach(wheel),
                _ if input.shift => Action::Dolly(wheel),
                _ => Action::Zoom(wheel),
            });
        }
        let Some(cursor) = input.cursor else {
            self.hold = Hold::Nothing;
            return;
        };
        match (input.button, self.hold) {
            (_, Hold::Ground { last }) if input.orbit => {
                let (right, down) = (cursor.0 - last.0, cursor.1 - last.1);
                if (right, down) != (0, 0) {
                    actions.push(Action::Orbit(right.into(), down.into()));
                }
                self.hold = Hold::Ground { last: cursor };
            }
            (_, Hold::Ground { .. }) => self.hold = Hold::Nothing,
            (false, Hold::Nothing) if input.orbit => {
                actions.push(Action::HoldGround);
                self.hold = Hold::Ground { last: cursor };
            }
            (true, Hold::Nothing) => {
                let near = split
                    .is_some_and(|place| (layout.across(place) as i32 - cursor.0).abs() <= GRIP);
                self.hold = if near {
                    Hold::Split
                } else {
                    Hold::Scene { from: cursor, last: cursor, moved: false }
                };
            }
            (true, Hold::Split) => {
                let width = (layout.columns * layout.scale).max(1) as f64;
                let place = f64::from(cursor.0 - layout.left as i32) / width;
                actions.push(Action::MoveSplit(place));
            }
            (true, Hold::Scene { from, last, moved }) => {
                let slipped = |a: i32, b: i32| (a - b).abs() > SLIP;
                if moved || slipped(cursor.0, from.0) || slipped(cursor.1, from.1) {
                    let (right, down) = (cursor.0 - last.0, cursor.1 - last.1);
                    if (right, down) != (0, 0) {
                        actions.push(Action::Drag(right.into(), down.into()));
                    }
                    self.hold = Hold::Scene { from, last: cursor, moved: true };
                }
            }
            (false, Hold::Scene { from, moved: false, .. }) => {
                actions.push(Action::Explain(from.0, from.1));
                self.hold = Hold::Nothing;
            }
            (false, _) => self.hold = Hold::Nothing,
        }
    }
}

/// What a key that goes down means.
fn of(key: Key) -> Option<Action> {
    let picture = |side, digit: u8| {
        let index = usize::from(digit).checked_sub(1)?;
        Picture::ALL.get(index).map(|&picture| Action::Picture(side, picture))
    };
    Some(match key {
        Key::Char(digit @ '1'..='6') => return picture(Side::Left, digit as u8 - b'0'),
        Key::Char('7') => Action::NextErrors(Side::Left),
        Key::Shifted(7) => Action::NextErrors(Side::Right),
        Key::Char('8') => Action::ErrorRange(-1),
        Key::Char('9') => Action::ErrorRange(1),
        Key::Char('0') => Action::FreeErrorRange,
        Key::Shifted(digit) => return picture(Side::Right, digit),
        Key::Char('g') => Action::NextEngine(Side::Left),
        Key::Char('G') => Action::NextEngine(Side::Right),
        Key::Char('k' | 'K') => Action::NextShape,
        Key::Char('j' | 'J') => Action::NextDeformation,
        Key::Char('[') => Action::Weight(-1),
        Key::Char(']') => Action::Weight(1),
        Key::Char('v') => Action::Exaggerate(1),
        Key::Char('V') => Action::Exaggerate(-1),
        Key::Char('l') => Action::TurnSun(SUN.0, 0.0),
        Key::Char('L') => Action::TurnSun(-SUN.0, 0.0),
        Key::Char('o') => Action::TurnSun(0.0, SUN.1),
        Key::Char('O') => Action::TurnSun(0.0, -SUN.1),
        Key::Char('p') => Action::NextRamp(1),
        Key::Char('P') => Action::NextRamp(-1),
        Key::Char('/') => Action::ToggleSplit,
        Key::Char(' ') => Action::TogglePause,
        Key::Char('.') => Action::OneLine,
        Key::Char('+' | '=') => Action::Faster,
        Key::Char('-' | '_') => Action::Slower,
        Key::Char('S') => Action::Screenshot,
        Key::Char('c' | 'C') => Action::CopyScene,
        Key::Char('h' | 'H' | '?') => Action::ToggleHelp,
        Key::Char('r' | 'R') | Key::Home => Action::Reset,
        Key::Char('f' | 'F') => Action::FrameMap,
        Key::PageDown => Action::Page(1),
        Key::PageUp => Action::Page(-1),
        Key::Tab => Action::TogglePanels,
        Key::Escape => Action::Quit,
        _ => return None,
    })
}

/// What the keys that are down mean.
fn flight(input: &Input, seconds: f64) -> Vec<Action> {
    let down = |key| f64::from(u8::from(input.held.contains(&key)));
    let pair = |plus, minus| down(plus) - down(minus);
    let letter = |plus, minus| pair(Key::Char(plus), Key::Char(minus));
    let course =
        Course { forward: letter('w', 's'), right: letter('d', 'a'), up: letter('e', 'q') };
    let mut actions = Vec::new();
    if course != Course::default() {
        actions.push(Action::Fly(course, if input.shift { HURRY * seconds } else { seconds }));
    }
    let angle = TURN * seconds;
    let heading = angle * pair(Key::Left, Key::Right);
    let pitch = angle * pair(Key::Up, Key::Down);
    let roll = angle * pair(Key::RollRight, Key::RollLeft);
    if [heading, pitch, roll] != [0.0; 3] {
        actions.push(Action::Turn(heading, pitch, roll));
    }
    actions
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYOUT: Layout =
        Layout { width: 200, height: 100, scale: 2, columns: 100, lines: 50, left: 0, top: 0 };

    fn tick(hands: &mut Hands, at: (i32, i32), button: bool) -> Vec<Action> {
        let input = Input { cursor: Some(at), button, ..Input::default() };
        let mut actions = hands.actions(&input, &LAYOUT, Some(0.5), 0.1);
        actions.retain(|action| !matches!(action, Action::Point(_)));
        actions
    }

    #[test]
    fn a_click_explains_and_a_drag_turns() {
        let mut hands = Hands::default();
        assert_eq!(tick(&mut hands, (20, 30), true), []);
        assert_eq!(tick(&mut hands, (22, 31), true), []);
        assert_eq!(tick(&mut hands, (22, 31), false), [Action::Explain(20, 30)]);
        assert_eq!(tick(&mut hands, (20, 30), true), []);
        assert_eq!(tick(&mut hands, (30, 25), true), [Action::Drag(10.0, -5.0)]);
        assert_eq!(tick(&mut hands, (31, 25), true), [Action::Drag(1.0, 0.0)]);
        assert_eq!(tick(&mut hands, (31, 25), false), []);
    }

    #[test]
    fn the_right_button_orbits_and_the_wheel_then_approaches() {
        let mut hands = Hands::default();
        let mut tick = |at: (i32, i32), orbit, wheel| {
            let input = Input { cursor: Some(at), orbit, wheel, ..Input::default() };
            let mut actions = hands.actions(&input, &LAYOUT, Some(0.5), 0.1);
            actions.retain(|action| !matches!(action, Action::Point(_)));
            actions
        };
        assert_eq!(tick((100, 30), true, 0.0), [Action::HoldGround]);
        assert_eq!(tick((90, 35), true, 0.0), [Action::Orbit(-10.0, 5.0)]);
        assert_eq!(tick((90, 35), true, 2.0), [Action::Approach(2.0)]);
        assert_eq!(tick((95, 35), false, 0.0), []);
        assert_eq!(tick((95, 35), false, 2.0), [Action::Zoom(2.0)]);
    }

    #[test]
    fn the_split_is_dragged_where_it_is_gripped() {
        let mut hands = Hands::default();
        assert_eq!(tick(&mut hands, (104, 30), true), []);
        assert_eq!(tick(&mut hands, (50, 80), true), [Action::MoveSplit(0.25)]);
        assert_eq!(tick(&mut hands, (50, 80), false), []);
    }

    #[test]
    fn the_wheel_zooms_and_with_shift_moves() {
        let mut hands = Hands::default();
        let mut input = Input { wheel: 2.0, ..Input::default() };
        assert_eq!(hands.actions(&input, &LAYOUT, None, 0.1), [Action::Zoom(2.0)]);
        input.shift = true;
        assert_eq!(hands.actions(&input, &LAYOUT, None, 0.1), [Action::Dolly(2.0)]);
    }

    #[test]
    fn keys_that_are_down_fly_and_turn() {
        let held = |held: &[Key], shift| {
            flight(&Input { held: held.to_vec(), shift, ..Input::default() }, 0.5)
        };
        let forward = Course { forward: 1.0, ..Course::default() };
        assert_eq!(held(&[Key::Char('w')], false), [Action::Fly(forward, 0.5)]);
        assert_eq!(held(&[Key::Char('w')], true), [Action::Fly(forward, 2.0)]);
        assert_eq!(held(&[Key::Char('w'), Key::Char('s')], false), []);
        let back = Course { forward: -1.0, ..forward };
        assert_eq!(held(&[Key::Char('s')], true), [Action::Fly(back, 2.0)]);
        assert_eq!(held(&[Key::Left], false), [Action::Turn(20.0, 0.0, 0.0)]);
        assert_eq!(held(&[Key::RollRight], true), [Action::Turn(0.0, 0.0, 20.0)]);
    }
}
