//! Values of a source's lines, and the pictures that they make.

use crate::sink::picture::{self, Painted, Picture};

use super::drawing::Order;
use super::pane::Source;
use super::sources::Band;

/// A source and the panes that show it.
pub(super) struct Task {
    pub(super) source: Source,
    pub(super) panes: Vec<usize>,
}

impl Task {
    pub(super) fn needs_buffers(&self, order: &Order) -> bool {
        self.panes.iter().any(|&pane| order.panes[pane].picture.needs_buffers())
    }
}

/// Values of all lines drawn so far.
#[derive(Default)]
pub(super) struct Values {
    color: Vec<[u8; 3]>,
    height: Vec<f64>,
    normal: Vec<[f64; 3]>,
    steps: Vec<u32>,
    cycles: Vec<u32>,
    errors: Vec<f64>,
    silhouettes: Vec<bool>,
}

impl Values {
    pub(super) fn push(&mut self, band: Band) {
        if let Some(frame) = band.frame {
            self.color.extend(frame.color);
            if let Some(buffers) = frame.buffers {
                self.height.extend(buffers.height);
                self.normal.extend(buffers.normal);
                self.steps.extend(buffers.steps);
            }
        }
        self.cycles.extend(band.cycles);
        self.errors.extend(band.errors);
        self.silhouettes.extend(band.silhouettes);
    }

    pub(super) fn pixels(&self) -> usize {
        self.color.len().max(self.errors.len())
    }

    pub(super) fn paint(&self, picture: Picture) -> Painted {
        match picture {
            Picture::Color => Painted { pixels: self.color.clone(), legend: None },
            Picture::Height => picture::height(&self.height),
            Picture::Normal => picture::normal(&self.normal),
            Picture::Steps => picture::steps(&self.steps),
            Picture::Error => picture::error(&self.errors, &self.silhouettes),
            Picture::Cycles => picture::cycles(&self.cycles),
        }
    }
}
