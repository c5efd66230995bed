//! The schema and how older files become it.

/// The migrations: the one at index n makes version n + 1 of version n.
pub(crate) const MIGRATIONS: &[&str] = &[
    "CREATE TABLE program (name TEXT PRIMARY KEY, place INTEGER NOT NULL, text BLOB NOT NULL) STRICT;
     CREATE TABLE kept (kind TEXT NOT NULL, name TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY (kind, name)) STRICT;",
    "ALTER TABLE program ADD COLUMN protected INTEGER NOT NULL DEFAULT 0;
     CREATE TABLE history (number INTEGER PRIMARY KEY AUTOINCREMENT, list TEXT NOT NULL, entry TEXT NOT NULL) STRICT;
     CREATE INDEX history_by_list ON history (list, number);",
];

/// The version that this program writes.
pub const VERSION: usize = MIGRATIONS.len();
