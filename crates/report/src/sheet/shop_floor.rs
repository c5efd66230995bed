//! The tool in the spindle, by the two customs there are: T alone changes it, or M06 changes to the T called before.

use super::tool::ToolSheet;

/// The machine code that changes tools, by custom of the trade.
pub const TOOL_CHANGE: u32 = 6;

/// The tools by one custom.
#[derive(Default)]
pub struct Spindle {
    /// Tools in the order of their use; the first is that in the spindle at the start.
    pub tools: Vec<ToolSheet>,
    current: usize,
}

impl Spindle {
    fn new() -> Spindle {
        Spindle { tools: vec![ToolSheet::default()], current: 0 }
    }

    /// The tool in the spindle.
    pub fn tool(&mut self) -> Option<&mut ToolSheet> {
        self.tools.get_mut(self.current)
    }

    fn change(&mut self, called: &ToolSheet) {
        match self.tools.iter_mut().position(|tool| tool.tool == called.tool) {
            Some(index) => {
                self.current = index;
                if let Some(tool) = self.tools.get_mut(index) {
                    let new = called.remarks.iter().filter(|remark| !tool.remarks.contains(remark));
                    let new: Vec<_> = new.cloned().collect();
                    tool.remarks.extend(new);
                }
            }
            None => {
                self.current = self.tools.len();
                self.tools.push(called.clone());
            }
        }
    }
}

/// Both customs, until the program's end shows which it follows.
pub struct ShopFloor {
    /// T alone changes.
    by_t: Spindle,
    /// M06 changes.
    by_m06: Spindle,
    /// The tool called last, with the remarks of its block.
    called: Option<ToolSheet>,
    changes: bool,
}

impl ShopFloor {
    /// Nothing called yet.
    pub fn new() -> ShopFloor {
        ShopFloor { by_t: Spindle::new(), by_m06: Spindle::new(), called: None, changes: false }
    }

    /// A T goes out.
    pub fn call(&mut self, tool: ToolSheet) {
        self.by_t.change(&tool);
        self.called = Some(tool);
    }

    /// An M code goes out; `remarks` are those of its block.
    pub fn machine_code(&mut self, code: u32, remarks: &[String]) {
        if code != TOOL_CHANGE {
            return;
        }
        self.changes = true;
        if let Some(called) = &mut self.called {
            called
                .remarks
                .extend(remarks.iter().filter(|remark| !called.remarks.contains(remark)).cloned().collect::<Vec<_>>());
            self.by_m06.change(called);
        }
    }

    /// The tool in the spindle, by both customs.
    pub fn tools(&mut self) -> impl Iterator<Item = &mut ToolSheet> {
        self.by_t.tool().into_iter().chain(self.by_m06.tool())
    }

    /// The tools by the custom that the program follows. That at the start is left out if it cuts nothing and others do.
    pub fn finish(self) -> Vec<ToolSheet> {
        let Spindle { mut tools, .. } = if self.changes { self.by_m06 } else { self.by_t };
        if tools.len() > 1 && !tools.first().is_some_and(ToolSheet::cuts) {
            tools.remove(0);
        }
        tools
    }
}
