//! The C functions of `shim/model.cpp`: the only unsafe code of the package.
#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char};

#[repr(C)]
struct Opaque {
    _private: [u8; 0],
}

unsafe extern "C" {
    fn rtl_make(name: *const c_char) -> *mut Opaque;
    fn rtl_drop(model: *mut Opaque);
    fn rtl_eval(model: *mut Opaque);
    fn rtl_ports(model: *const Opaque) -> u32;
    fn rtl_port_name(model: *const Opaque, port: u32) -> *const c_char;
    fn rtl_port_width(model: *const Opaque, port: u32) -> u32;
    fn rtl_port_is_input(model: *const Opaque, port: u32) -> bool;
    fn rtl_get(model: *const Opaque, port: u32, word: u32) -> u64;
    fn rtl_set(model: *mut Opaque, port: u32, word: u32, value: u64);
    fn rtl_open_trace(model: *mut Opaque, path: *const c_char) -> bool;
    fn rtl_dump(model: *mut Opaque, time: u64);
}

/// A port as the model declares it.
#[derive(Clone, Debug)]
pub(crate) struct Declared {
    pub name: String,
    pub width: u32,
    pub input: bool,
}

/// An owned model.
#[derive(Debug)]
pub(crate) struct Handle {
    model: *mut Opaque,
    ports: u32,
    tracing: bool,
}

// SAFETY: a model has its own context and shares nothing with other models; it may be used by any
// one thread.
unsafe impl Send for Handle {}

impl Handle {
    pub fn new(name: &str) -> Option<Self> {
        let name = CString::new(name).ok()?;
        // SAFETY: the name is a C string that outlives the call.
        let model = unsafe { rtl_make(name.as_ptr()) };
        if model.is_null() {
            return None;
        }
        // SAFETY: the model is not null.
        let ports = unsafe { rtl_ports(model) };
        Some(Self { model, ports, tracing: false })
    }

    pub fn ports(&self) -> Vec<Declared> {
        (0..self.ports)
            .map(|port| {
                // SAFETY: the port exists; its name is a literal of the model's.
                let name = unsafe { CStr::from_ptr(rtl_port_name(self.model, port)) };
                Declared {
                    name: name.to_string_lossy().into_owned(),
                    // SAFETY: the port exists.
                    width: unsafe { rtl_port_width(self.model, port) },
                    // SAFETY: the port exists.
                    input: unsafe { rtl_port_is_input(self.model, port) },
                }
            })
            .collect()
    }

    pub fn eval(&mut self) {
        // SAFETY: the model is not null.
        unsafe { rtl_eval(self.model) }
    }

    /// Bits 64·word and up of a port; the word lies within the port's width.
    pub fn get(&self, port: u32, word: u32) -> u64 {
        assert!(port < self.ports);
        // SAFETY: the port exists, and `Model` keeps the word within its width.
        unsafe { rtl_get(self.model, port, word) }
    }

    pub fn set(&mut self, port: u32, word: u32, value: u64) {
        assert!(port < self.ports);
        // SAFETY: as in `get`.
        unsafe { rtl_set(self.model, port, word, value) }
    }

    pub fn open_trace(&mut self, path: &str) -> bool {
        let Ok(path) = CString::new(path) else { return false };
        // SAFETY: the path is a C string that outlives the call.
        self.tracing = unsafe { rtl_open_trace(self.model, path.as_ptr()) };
        self.tracing
    }

    pub fn dump(&mut self, time: u64) {
        assert!(self.tracing, "a trace is open");
        // SAFETY: a trace is open.
        unsafe { rtl_dump(self.model, time) }
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: the model is not used after this.
        unsafe { rtl_drop(self.model) }
    }
}
