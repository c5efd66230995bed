//! The arguments of `diff`: the set-up of both sides, and what either has of its own.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::SettingArguments;

/// How a comparison is printed.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum DiffFormat {
    /// For people.
    Text,
    /// One JSON object.
    Json,
}

/// `diff`
#[derive(Args, Debug)]
pub struct DiffArguments {
    /// The first program, - for standard input
    #[arg(value_name = "A")]
    pub first: String,
    /// The second program [default: the first, with what options in -a or -b make different]
    #[arg(value_name = "B")]
    pub second: Option<String>,
    /// How the comparison is printed
    #[arg(long, value_enum, default_value = "text")]
    pub format: DiffFormat,
    /// How far apart places may lie and still be one, mm and degrees [default: one least increment]
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub tolerance: Option<f64>,
    /// Events looked through for the place where both agree again
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    pub window: u64,
    /// How many differences are shown
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub show: usize,
    /// The control and its set-up, for both sides.
    #[command(flatten)]
    pub setting: SettingArguments,
    /// What A has of its own.
    #[command(flatten)]
    pub a: SideA,
    /// What B has of its own.
    #[command(flatten)]
    pub b: SideB,
}

impl DiffArguments {
    /// The set-up of A and that of B: what both have, with what each has of its own over it.
    pub fn settings(&self) -> [SettingArguments; 2] {
        [self.setting.with(&self.a.own()), self.setting.with(&self.b.own())]
    }

    /// True if there is nothing in which the sides could differ.
    pub fn is_one_thing(&self) -> bool {
        self.second.is_none() && self.a.own() == Own::default() && self.b.own() == Own::default()
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("write a number of mm, 0 or more".to_owned()),
    }
}

/// What one side has of its own.
#[derive(Debug, Default, PartialEq)]
pub struct Own {
    control: Option<String>,
    machine: Option<String>,
    setup: Option<PathBuf>,
    library: Option<PathBuf>,
    offset: Vec<String>,
    work: Vec<String>,
    parameter: Vec<String>,
    switch: Vec<String>,
    option: Vec<String>,
    policy: Vec<String>,
}

impl SettingArguments {
    /// The same with what one side has of its own: single things take their place, lists follow.
    fn with(&self, own: &Own) -> SettingArguments {
        let both = |common: &Vec<String>, own: &Vec<String>| [&common[..], &own[..]].concat();
        SettingArguments {
            control: own.control.clone().unwrap_or_else(|| self.control.clone()),
            controls: self.controls.clone(),
            machine: own.machine.clone().or_else(|| self.machine.clone()),
            setup: own.setup.clone().or_else(|| self.setup.clone()),
            offset: both(&self.offset, &own.offset),
            work: both(&self.work, &own.work),
            parameter: both(&self.parameter, &own.parameter),
            switch: both(&self.switch, &own.switch),
            library: own.library.clone().or_else(|| self.library.clone()),
            option: both(&self.option, &own.option),
            policy: both(&self.policy, &own.policy),
            repeat: self.repeat,
            loop_limit: self.loop_limit,
        }
    }
}

/// The options of one side: those of the set-up with the side's letter behind them.
macro_rules! side {
    ($name:ident, $letter:literal, $upper:literal) => {
        #[doc = concat!("What ", $upper, " has of its own.")]
        #[derive(Args, Debug)]
        #[command(next_help_heading = concat!("Of ", $upper, " alone: over what both have"))]
        pub struct $name {
            /// --control
            #[arg(id = concat!("control-", $letter), long = concat!("control-", $letter), value_name = "NAME")]
            control: Option<String>,
            /// --machine
            #[arg(id = concat!("machine-", $letter), long = concat!("machine-", $letter), value_name = "NAME|FILE.toml")]
            machine: Option<String>,
            /// --setup
            #[arg(id = concat!("setup-", $letter), long = concat!("setup-", $letter), value_name = "FILE.toml")]
            setup: Option<PathBuf>,
            /// --library
            #[arg(id = concat!("library-", $letter), long = concat!("library-", $letter), value_name = "DIR")]
            library: Option<PathBuf>,
            /// --offset
            #[arg(id = concat!("offset-", $letter), long = concat!("offset-", $letter), value_name = "N=MM", allow_hyphen_values = true)]
            offset: Vec<String>,
            /// --work
            #[arg(id = concat!("work-", $letter), long = concat!("work-", $letter), value_name = "Gnn=X…,Y…")]
            work: Vec<String>,
            /// --parameter
            #[arg(id = concat!("parameter-", $letter), long = concat!("parameter-", $letter), value_name = "NAME=VALUE")]
            parameter: Vec<String>,
            /// --switch
            #[arg(id = concat!("switch-", $letter), long = concat!("switch-", $letter), value_name = "NAME")]
            switch: Vec<String>,
            /// --option
            #[arg(id = concat!("option-", $letter), long = concat!("option-", $letter), value_name = "NAME=on|off")]
            option: Vec<String>,
            /// --policy
            #[arg(id = concat!("policy-", $letter), long = concat!("policy-", $letter), value_name = "NAME=VALUE")]
            policy: Vec<String>,
        }

        impl $name {
            fn own(&self) -> Own {
                Own {
                    control: self.control.clone(),
                    machine: self.machine.clone(),
                    setup: self.setup.clone(),
                    library: self.library.clone(),
                    offset: self.offset.clone(),
                    work: self.work.clone(),
                    parameter: self.parameter.clone(),
                    switch: self.switch.clone(),
                    option: self.option.clone(),
                    policy: self.policy.clone(),
                }
            }
        }
    };
}

side!(SideA, "a", "A");
side!(SideB, "b", "B");
