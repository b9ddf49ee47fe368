//! How fast the scan falls.

/// Lines per second, slowest first; beyond the last one lies the full rate.
const SPEEDS: [u32; 7] = [1, 4, 16, 64, 256, 1024, 4096];

/// Pace of the scan. Lines are granted to the render worker as time passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Index into the speeds; their number is the full rate.
    level: usize,
    paused: bool,
    /// Parts of a line that time has earned.
    earned: f64,
}

impl Default for Pace {
    fn default() -> Self {
        Self { level: SPEEDS.len(), paused: false, earned: 0.0 }
    }
}

impl Pace {
    /// Whole frames as fast as they can be drawn, not lines by and by.
    #[must_use]
    pub fn is_full(self) -> bool {
        !self.paused && self.level == SPEEDS.len()
    }

    /// Whether the scan stands.
    #[must_use]
    pub fn is_paused(self) -> bool {
        self.paused
    }

    /// Lines per second; `None` at the full rate.
    #[must_use]
    pub fn lines_per_second(self) -> Option<u32> {
        SPEEDS.get(self.level).copied()
    }

    /// One speed up.
    pub fn faster(&mut self) {
        self.level = (self.level + 1).min(SPEEDS.len());
    }

    /// One speed down.
    pub fn slower(&mut self) {
        self.level = self.level.saturating_sub(1);
    }

    /// Stops the scan, or lets it go on.
    pub fn toggle_pause(&mut self) {
        self.paused = !self.paused;
        self.earned = 0.0;
    }

    /// Stops the scan.
    pub fn pause(&mut self) {
        self.paused = true;
        self.earned = 0.0;
    }

    /// Lines that `seconds` more have earned.
    pub fn advance(&mut self, seconds: f64) -> u32 {
        let Some(speed) = self.lines_per_second().filter(|_| !self.paused) else { return 0 };
        self.earned += seconds * f64::from(speed);
        let lines = self.earned.floor();
        self.earned -= lines;
        lines as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_earns_lines_whatever_its_parts() {
        let mut pace = Pace::default();
        assert!(pace.is_full());
        for _ in 0..4 {
            pace.slower();
        }
        assert_eq!(pace.lines_per_second(), Some(64));
        assert_eq!((0..1000).map(|_| pace.advance(1.0 / 128.0)).sum::<u32>(), 500);
        pace.toggle_pause();
        assert_eq!(pace.advance(10.0), 0);
        pace.toggle_pause();
        for _ in 0..20 {
            pace.slower();
        }
        assert_eq!(
            (pace.lines_per_second(), pace.advance(0.75), pace.advance(0.75)),
            (Some(1), 0, 1)
        );
        for _ in 0..20 {
            pace.faster();
        }
        assert!(pace.is_full());
    }
}
