//! Fields that are arrays: tables, vectors, sizes, colours.

use std::ops::RangeInclusive;

use glam::{DVec2, DVec3};

use super::error::SceneError;
use super::field::{FARTHEST, Field, is_length};
use super::tree::{Node, Value, shown};

impl<'a> Field<'a> {
    /// The elements of an array.
    pub(super) fn elements(&self, expected: &str) -> Result<Vec<Self>, SceneError> {
        let Value::Array(nodes) = &self.node.value else {
            return Err(self.expected(expected));
        };
        let element = |(index, node): (usize, &'a Node)| Field {
            context: self.context,
            path: format!("{}.{index}", self.path),
            origin: node.origin,
            node,
        };
        Ok(nodes.iter().enumerate().map(element).collect())
    }

    /// The tables of an array of tables. A lone one is called without its index.
    pub(super) fn tables(&self) -> Result<Vec<Self>, SceneError> {
        let expected = format!("tables, each under a line [[{}]]", self.path);
        let mut tables = self.elements(&expected)?;
        match tables.as_mut_slice() {
            [] => return Err(self.expected(&expected)),
            [lone] => lone.path.clone_from(&self.path),
            _ => {}
        }
        Ok(tables)
    }

    /// The elements of an array of fixed length. Messages call them by the name of the array:
    /// that is the field, its element is the place.
    fn fixed<const N: usize>(&self, expected: &str) -> Result<[Self; N], SceneError> {
        let mut elements = self.elements(expected)?;
        for element in &mut elements {
            element.path.clone_from(&self.path);
        }
        elements.try_into().map_err(|_| self.expected(expected))
    }

    fn numbers<const N: usize>(&self, expected: &str) -> Result<[f64; N], SceneError> {
        let mut numbers = [0.0; N];
        for (number, element) in numbers.iter_mut().zip(self.fixed::<N>(expected)?) {
            *number = element.finite(expected)?;
        }
        Ok(numbers)
    }

    /// A vector no longer than [`FARTHEST`].
    pub(super) fn position(&self) -> Result<DVec3, SceneError> {
        const EXPECTED: &str = "three numbers [x, y, z] no farther than 1e9 from the origin";
        let vector = DVec3::from_array(self.numbers(EXPECTED)?);
        if vector.length() <= FARTHEST {
            Ok(vector)
        } else {
            Err(self.error(
                format!("{} is too far away", shown_all(&vector.to_array())),
                format!("give {EXPECTED}"),
            ))
        }
    }

    /// A vector that points somewhere.
    pub(super) fn direction(&self) -> Result<DVec3, SceneError> {
        const EXPECTED: &str = "three numbers [x, y, z], not all 0, of a length up to 1e9";
        let vector = DVec3::from_array(self.numbers(EXPECTED)?);
        if is_length(vector.length()) {
            Ok(vector)
        } else {
            Err(self.error(
                format!("{} gives no direction", shown_all(&vector.to_array())),
                format!("give {EXPECTED}"),
            ))
        }
    }

    /// Two numbers that both pass the test.
    pub(super) fn pair(
        &self,
        expected: &str,
        test: impl Fn(f64) -> bool,
    ) -> Result<DVec2, SceneError> {
        let numbers: [f64; 2] = self.numbers(expected)?;
        if numbers.iter().all(|&number| test(number)) {
            Ok(DVec2::from_array(numbers))
        } else {
            Err(self.error(format!("found {}", shown_all(&numbers)), format!("give {expected}")))
        }
    }

    /// Two whole numbers in a range.
    pub(super) fn counts(
        &self,
        expected: &str,
        range: RangeInclusive<u32>,
    ) -> Result<[u32; 2], SceneError> {
        let mut counts = [0; 2];
        for (count, element) in counts.iter_mut().zip(self.fixed::<2>(expected)?) {
            *count = element.count(range.clone()).map_err(|_| element.expected(expected))?;
        }
        Ok(counts)
    }

    /// An sRGB colour.
    pub(super) fn color(&self) -> Result<[u8; 3], SceneError> {
        const EXPECTED: &str = "[red, green, blue], three whole numbers from 0 to 255";
        let mut color = [0; 3];
        for (byte, element) in color.iter_mut().zip(self.fixed::<3>(EXPECTED)?) {
            let value = element.integer(0..=255).map_err(|_| element.expected(EXPECTED))?;
            *byte = value as u8;
        }
        Ok(color)
    }
}

/// Whether a vector is as near to unit length as normalising makes one: it is then taken as it is,
/// so that directions that were written by the program are read back in every bit.
pub(super) fn is_unit(vector: DVec3) -> bool {
    (vector.length() - 1.0).abs() <= 1e-15
}

fn shown_all(numbers: &[f64]) -> String {
    let shown: Vec<String> = numbers.iter().map(|&number| shown(number)).collect();
    format!("[{}]", shown.join(", "))
}
