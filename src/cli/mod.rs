//! The command line: one file per command. Results go to stdout, everything else to stderr; exit
//! code 0 done, 1 a study found a failure, 2 bad input.

mod compare;
mod cycles;
mod explain;
mod info;
mod outputs;
mod plan;
mod reading;
mod render;
pub mod report;
pub mod scene_args;
mod scene_out;
mod scenes;
mod vectors;
mod view;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Emulator of a dedicated raster processor for flight-simulator terrain.
#[derive(Debug, Parser)]
#[command(name = "terraline", version, about, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    View(view::View),
    Render(render::Render),
    Explain(explain::Explain),
    Plan(plan::PlanCommand),
    Cycles(cycles::Cycles),
    Vectors(vectors::Vectors),
    Compare(compare::Compare),
    Scenes(scenes::Scenes),
    Info(info::Info),
}

/// Why a command stops.
#[derive(Debug)]
pub enum Stop {
    /// Exit 1: a study found a failure; the report says which.
    Failure,
    /// Exit 2: one message.
    BadInput(String),
}

impl<E: std::error::Error> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::BadInput(error.to_string())
    }
}

const THREE_THINGS: &str = "\
Terraline emulates a dedicated raster processor for flight-simulator terrain.
Things to try:
  terraline view flight                        fly over the built-in map (H shows the keys)
  terraline render -o frame.png                draw the built-in scene `overview`
  terraline render dem.tif -o terrain.png      draw your own height file
  terraline explain overview --pixel 400,700   follow one pixel from set-up to colour
Scenes to start from: terraline scenes. All commands: terraline --help";

/// Runs the command line of this process.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match arguments.command {
        None => {
            report::print(THREE_THINGS);
            Ok(())
        }
        Some(Command::View(command)) => command.run(),
        Some(Command::Render(command)) => command.run(),
        Some(Command::Explain(command)) => command.run(),
        Some(Command::Plan(command)) => command.run(),
        Some(Command::Cycles(command)) => command.run(),
        Some(Command::Vectors(command)) => command.run(),
        Some(Command::Compare(command)) => command.run(),
        Some(Command::Scenes(command)) => command.run(),
        Some(Command::Info(command)) => command.run(),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Stop::Failure) => ExitCode::from(1),
        Err(Stop::BadInput(message)) => {
            eprintln!("terraline: {message}");
            ExitCode::from(2)
        }
    }
}
