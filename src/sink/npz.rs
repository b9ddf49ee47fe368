//! Buffers as a `.npz` file: a zip archive of `.npy` arrays, as numpy's `load` reads it.

use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

use zip::read::ZipFile;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter};

use super::npy::{Dtype, Header};
use super::{ReadError, SinkError, write_atomically};
use crate::frame::Frame;

/// Most arrays that a file may hold.
const MAX_ARRAYS: usize = 1024;

/// Elements that pass through memory at a time.
const CHUNK: usize = 1 << 14;

const WHOLE_FILE: &str = "give a whole .npz file, as numpy's savez or this program writes it";

/// Writes the arrays of a frame, those of [`frame::TABLE`](crate::frame::TABLE) that it holds, as
/// their entries describe them: lines and columns are the first axes, in C order. The same frame
/// gives the same bytes. Arrays are compressed piece by piece; nothing is held in memory twice.
///
/// # Errors
/// [`SinkError`]; nothing is left half-written.
pub fn write(path: &Path, frame: &Frame) -> Result<(), SinkError> {
    let (columns, lines) = (frame.columns, frame.lines);
    for (row, scalars) in frame.arrays() {
        let found = scalars.len() / row.components;
        if Some(found) != columns.checked_mul(lines) {
            let (path, array) = (path.to_owned(), row.name);
            return Err(SinkError::Shape { path, array, columns, lines, found });
        }
    }
    write_atomically(path, |out| {
        let mut zip = ZipWriter::new(out);
        // Sizes are known only afterwards, so that room for 64 bits is left in every case.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .compression_level(Some(6))
            .last_modified_time(DateTime::DEFAULT)
            .unix_permissions(0o644)
            .system(System::Unix)
            .large_file(true);
        for (row, scalars) in frame.arrays() {
            zip.start_file(format!("{}.npy", row.name), options)?;
            let header = Header { dtype: row.dtype, shape: row.shape(lines, columns) };
            zip.write_all(&header.to_bytes())?;
            for piece in scalars.pieces(CHUNK) {
                zip.write_all(&piece)?;
            }
        }
        zip.finish()?;
        Ok(())
    })
}

/// A `.npz` file opened for reading; arrays are read one after the other, piece by piece.
pub struct Npz<R> {
    path: PathBuf,
    archive: ZipArchive<R>,
    names: Vec<String>,
}

impl Npz<BufReader<File>> {
    /// Opens a file.
    ///
    /// # Errors
    /// [`ReadError`] when the file is missing, unreadable, or no `.npz`.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let file = File::open(path).map_err(|error| ReadError::open(path, &error))?;
        Self::new(path, BufReader::new(file))
    }
}

impl<R: Read + Seek> Npz<R> {
    /// Reads the directory of an archive; `path` is its name in messages.
    ///
    /// # Errors
    /// [`ReadError`] when it is no zip archive, is damaged, or holds no arrays, more than 1024
    /// files, or two of one name.
    pub fn new(path: &Path, input: R) -> Result<Self, ReadError> {
        let archive = ZipArchive::new(input).map_err(|error| {
            let reason = format!("it is no .npz file or is damaged ({error})");
            ReadError::new(path, reason, WHOLE_FILE)
        })?;
        if archive.len() > MAX_ARRAYS || archive.has_duplicate_names() {
            let reason = format!("it holds more than {MAX_ARRAYS} files or two of one name");
            return Err(ReadError::new(path, reason, WHOLE_FILE));
        }
        let names: Vec<String> = archive
            .file_names()
            .filter_map(|name| Some(name.ok()?.strip_suffix(".npy")?.to_owned()))
            .collect();
        if names.is_empty() {
            return Err(ReadError::new(path, "it holds no arrays", WHOLE_FILE));
        }
        Ok(Self { path: path.to_owned(), archive, names })
    }

    /// Names of the arrays, in the order of the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Opens one array and reads its header.
    ///
    /// # Errors
    /// [`ReadError`] when there is no such array, its compression or type is not read, its shape
    /// exceeds the limits of [`npy`](super::npy), or its size is not that of its shape.
    pub fn array(&mut self, name: &str) -> Result<ArrayReader<'_, R>, ReadError> {
        let path = &self.path;
        let wrong =
            |reason: String| ReadError::new(path, format!("array `{name}`: {reason}"), WHOLE_FILE);
        let mut entry =
            self.archive.by_name(&format!("{name}.npy")).map_err(|e| wrong(e.to_string()))?;
        let mut counted = Counted { input: &mut entry, bytes: 0 };
        let header = Header::read(&mut counted).map_err(|e| wrong(reason(&e)))?;
        let before = counted.bytes;
        let elements = header.elements().unwrap_or(0);
        let expected = before + elements * header.dtype.bytes() as u64;
        if entry.size() != expected {
            let size = entry.size();
            return Err(wrong(format!("it has {size} bytes where its shape needs {expected}")));
        }
        let name = name.to_owned();
        Ok(ArrayReader { path, name, header, remaining: elements, checked: false, entry })
    }
}

/// An array that is being read.
pub struct ArrayReader<'a, R: Read> {
    path: &'a Path,
    name: String,
    header: Header,
    remaining: u64,
    /// The end has been read, and with it the checksum.
    checked: bool,
    entry: ZipFile<'a, R>,
}

impl<R: Read> ArrayReader<'_, R> {
    /// Type and shape of the array.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// Replaces `values` by the next elements in C order, each exact as `f64`; none at the end.
    ///
    /// Pieces have the same lengths in all arrays of the same number of elements.
    ///
    /// # Errors
    /// [`ReadError`] when the data is damaged, or shorter or longer than the header says.
    pub fn next_piece(&mut self, values: &mut Vec<f64>) -> Result<(), ReadError> {
        values.clear();
        self.read_piece(values).map_err(|error| {
            let reason = format!("array `{}`: {}", self.name, reason(&error));
            ReadError::new(self.path, reason, WHOLE_FILE)
        })
    }

    /// The remaining elements in C order, each exact as `f64`.
    ///
    /// # Errors
    /// As [`ArrayReader::next_piece`].
    #[cfg(feature = "parts")]
    pub fn read_all(mut self) -> Result<Vec<f64>, ReadError> {
        let (mut all, mut piece) = (Vec::new(), Vec::new());
        loop {
            self.next_piece(&mut piece)?;
            if piece.is_empty() {
                return Ok(all);
            }
            all.extend_from_slice(&piece);
        }
    }

    fn read_piece(&mut self, values: &mut Vec<f64>) -> io::Result<()> {
        let count = usize::try_from(self.remaining).map_or(CHUNK, |left| left.min(CHUNK));
        if count == 0 {
            return self.check_end();
        }
        let dtype = self.header.dtype;
        let mut bytes = vec![0; count * dtype.bytes()];
        self.entry.read_exact(&mut bytes)?;
        match dtype {
            Dtype::U1 => values.extend(bytes.iter().map(|&b| f64::from(b))),
            Dtype::U4 => {
                let words = bytes.as_chunks().0.iter();
                values.extend(words.map(|&b| f64::from(u32::from_le_bytes(b))));
            }
            Dtype::F8 => {
                let words = bytes.as_chunks().0.iter();
                values.extend(words.map(|&b| f64::from_le_bytes(b)));
            }
        }
        self.remaining -= count as u64;
        Ok(())
    }

    /// Reads to the end of the entry, where its checksum is compared.
    fn check_end(&mut self) -> io::Result<()> {
        if !self.checked {
            if self.entry.read(&mut [0])? != 0 {
                let reason = "it goes on beyond its shape";
                return Err(io::Error::new(ErrorKind::InvalidData, reason));
            }
            self.checked = true;
        }
        Ok(())
    }
}

/// Counts the bytes that pass.
struct Counted<T> {
    input: T,
    bytes: u64,
}

impl<T: Read> Read for Counted<T> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(buffer)?;
        self.bytes += read as u64;
        Ok(read)
    }
}

/// An error inside an array, in words.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::UnexpectedEof => "it is cut short".to_owned(),
        ErrorKind::InvalidData => error.to_string(),
        _ => format!("it is damaged ({error})"),
    }
}
