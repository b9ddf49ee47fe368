//! How each type of the scene is read from a value of the file and written as one.

use glam::{DVec2, DVec3};

use super::error::{SceneError, nearest};
use super::field::Field;
use super::kind::{FARTHEST, Kind, SMALLEST};
use super::shown::shown;
use super::tree;
use super::words::Words;
use super::writer::{degrees, direction, is_unit};

/// A type of the scene that is one value in the file. What is written reads back in every bit.
pub(super) trait Value: Sized {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError>;

    /// As TOML; nothing if the key is to be left out.
    fn write(&self, kind: &Kind) -> String;
}

impl Value for f64 {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        let expected = kind.expected();
        // The remainder of integers and of f64 is exact, so whole turns change nothing.
        if let (Kind::Turn, tree::Value::Integer(value)) = (kind, &field.node.value) {
            return Ok(((value % 360) as f64).to_radians());
        }
        let number = field.finite(&expected)?;
        match kind {
            Kind::Turn => Ok((number % 360.0).to_radians()),
            Kind::Degrees(range) if range.contains(&number) => Ok(number.to_radians()),
            Kind::Number(range) if range.contains(&number) => Ok(number),
            _ => Err(field.expected(&expected)),
        }
    }

    fn write(&self, kind: &Kind) -> String {
        match kind {
            Kind::Turn | Kind::Degrees(_) => format!("{:?}", degrees(*self)),
            // The shortest decimal that reads back.
            _ => format!("{self:?}"),
        }
    }
}

fn whole(field: &Field<'_>, kind: &Kind) -> Result<i64, SceneError> {
    let expected = kind.expected();
    let (Kind::Whole(range) | Kind::PowerOfTwo(range)) = kind else {
        return Err(field.expected(&expected));
    };
    let value = field.integer(&expected, range)?;
    if matches!(kind, Kind::Whole(_)) || value.count_ones() == 1 {
        return Ok(value);
    }
    let below = 1_i64 << value.ilog2();
    let reason = format!("{value} is not a power of two");
    Err(field.error(reason, format!("give {below} or {}", 2 * below)))
}

macro_rules! whole {
    ($($type:ty)+) => { $(
        impl Value for $type {
            fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
                // The ranges of all keys lie within their types.
                whole(field, kind).map(|value| value as $type)
            }

            fn write(&self, _: &Kind) -> String {
                self.to_string()
            }
        }
    )+ };
}

whole!(u8 u32 u64);

impl Value for String {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        let text = field.text(&kind.expected())?;
        match kind {
            Kind::Text { expected, refusal, fits } if !fits(text) => {
                Err(field.error(*refusal, format!("give {expected}")))
            }
            _ => Ok(text.to_owned()),
        }
    }

    fn write(&self, _: &Kind) -> String {
        quoted(self)
    }
}

/// Quoted and escaped.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// A value that may be left out, which is then decided otherwise.
impl<T: Value> Value for Option<T> {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        T::read(field, kind).map(Some)
    }

    fn write(&self, kind: &Kind) -> String {
        self.as_ref().map_or_else(String::new, |value| value.write(kind))
    }
}

impl<T: Words> Value for T {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        let all = kind.expected();
        let text = field.text(&all)?;
        if let Some((_, value)) = T::WORDS.iter().find(|(word, _)| *word == text) {
            return Ok(*value);
        }
        if matches!(kind, Kind::Word(_, unbuilt) if unbuilt.contains(&text)) {
            return Err(field.error(format!("\"{text}\" is not built yet"), format!("give {all}")));
        }
        let remedy = match nearest(text, T::WORDS.iter().map(|(word, _)| *word)) {
            Some(guess) => format!("did you mean \"{guess}\"? Give {all}"),
            None => format!("give {all}"),
        };
        Err(field.error(format!("found {}", field.node.describe()), remedy))
    }

    fn write(&self, _: &Kind) -> String {
        quoted(self.word())
    }
}

/// One of a few words, or else another value.
pub(super) fn word_or<T: Copy, Other: Value>(
    field: &Field<'_>,
    kind: &Kind,
    words: &[(&str, T)],
    make: impl Fn(Other) -> T,
) -> Result<T, SceneError> {
    let text = field.text("").unwrap_or_default();
    match (words.iter().find(|(word, _)| *word == text), kind) {
        (Some((_, value)), _) => Ok(*value),
        (None, Kind::WordOr(_, other)) => {
            Other::read(field, other).map(make).map_err(|_| field.expected(&kind.expected()))
        }
        (None, _) => Err(field.expected(&kind.expected())),
    }
}

impl<T: Value> Value for Vec<T> {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        let expected = kind.expected();
        match (kind, field.elements(&expected)?) {
            (Kind::Array(_, of, counts), elements) if counts.contains(&elements.len()) => {
                let read = |element: &Field<'_>| match **of {
                    Kind::Array(..) => T::read(element, of),
                    _ => T::read(element, of)
                        .map_err(|_| element.called(&field.path).expected(&expected)),
                };
                elements.iter().map(read).collect()
            }
            _ => Err(field.expected(&expected)),
        }
    }

    fn write(&self, kind: &Kind) -> String {
        let Kind::Array(_, of, _) = kind else { return String::new() };
        let values: Vec<String> = self.iter().map(|value| value.write(of)).collect();
        format!("[{}]", values.join(", "))
    }
}

impl<T: Value + Clone, const N: usize> Value for [T; N] {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        let values = Vec::<T>::read(field, kind)?;
        values.try_into().map_err(|_| field.expected(&kind.expected()))
    }

    fn write(&self, kind: &Kind) -> String {
        self.to_vec().write(kind)
    }
}

impl Value for DVec2 {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        Value::read(field, kind).map(Self::from_array)
    }

    fn write(&self, kind: &Kind) -> String {
        self.to_array().write(kind)
    }
}

impl Value for DVec3 {
    fn read(field: &Field<'_>, kind: &Kind) -> Result<Self, SceneError> {
        let expected = kind.expected();
        let numbers = field.elements(&expected)?;
        let numbers = numbers.iter().map(|number| number.called(&field.path).finite(&expected));
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
        let [x, y, z] = numbers[..] else { return Err(field.expected(&expected)) };
        let (vector, is_place) = (Self::new(x, y, z), matches!(kind, Kind::Position));
        if (if is_place { 0.0 } else { SMALLEST }..=FARTHEST).contains(&vector.length()) {
            let unit = matches!(kind, Kind::UnitDirection) && !is_unit(vector);
            return Ok(if unit { vector.normalize() } else { vector });
        }
        let what = if is_place { "is too far away" } else { "gives no direction" };
        let reason = format!("[{}, {}, {}] {what}", shown(x), shown(y), shown(z));
        Err(field.error(reason, format!("give {expected}")))
    }

    fn write(&self, kind: &Kind) -> String {
        let vector = if matches!(kind, Kind::UnitDirection) { direction(*self) } else { *self };
        format!("[{:?}, {:?}, {:?}]", vector.x, vector.y, vector.z)
    }
}
