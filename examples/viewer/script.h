/* SPDX-License-Identifier: Apache-2.0
 *
 * Actions of a user, read from a text, for tests and for pictures of the viewer. */
#ifndef MSQ_EXAMPLE_SCRIPT_H
#define MSQ_EXAMPLE_SCRIPT_H

#include <SDL.h>

typedef struct script {
  const char* at;      /* the rest of the text */
  int steps;           /* of the drag, or pictures of the spin, that are to come */
  int dx, dy, buttons; /* of each step */
  Uint64 began;
  int spun;
} script;

#define SCRIPT_HELP                                                                         \
  "commands with ; between them: drag DX DY, pan DX DY (pixels), wheel N, key C, spin N\n"  \
  "             (turns for N pictures, and says how many a second), wait (for the finest\n" \
  "             picture), shot FILE.png, quit"

enum { SCRIPT_ON, SCRIPT_SHOT, SCRIPT_ERROR };

/* Goes on with the script: pushes the events of one step once the picture of the last one is there.
 * is_drawn: 1 where the picture on screen is of the newest view, is_finest: and no better one will
 * come. Returns SCRIPT_SHOT where the window is to be saved as file, of room bytes. */
int script_go(script* s, int is_drawn, int is_finest, char* file, size_t room);

#endif
