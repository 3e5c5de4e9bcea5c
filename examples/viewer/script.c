/* SPDX-License-Identifier: Apache-2.0 */
#include "script.h"

#include <stdio.h>
#include <string.h>

enum { DRAG_STEPS = 6 };

static void push_motion(int dx, int dy, int buttons) {
  SDL_Event event;
  SDL_zero(event);
  event.type = SDL_MOUSEMOTION;
  event.motion.state = (Uint32)buttons;
  event.motion.xrel = dx;
  event.motion.yrel = dy;
  SDL_PushEvent(&event);
}

static void push_key(int key) {
  SDL_Event event;
  SDL_zero(event);
  event.type = SDL_KEYDOWN;
  event.key.keysym.sym = key;
  SDL_PushEvent(&event);
}

static void push_wheel(int notches) {
  SDL_Event event;
  SDL_zero(event);
  event.type = SDL_MOUSEWHEEL;
  event.wheel.y = notches;
  SDL_PushEvent(&event);
}

static void push_quit(void) {
  SDL_Event event;
  SDL_zero(event);
  event.type = SDL_QUIT;
  SDL_PushEvent(&event);
}

/* Ends a turn of so many pictures. */
static void end_spin(script* s) {
  const double seconds =
      (double)(SDL_GetPerformanceCounter() - s->began) / (double)SDL_GetPerformanceFrequency();
  printf("%d pictures in %.2f s: %.1f a second\n", s->spun, seconds, s->spun / seconds);
  push_key(SDLK_SPACE);
  s->spun = 0;
}

int script_go(script* s, int is_drawn, int is_finest, char* file, size_t room) {
  if (!is_drawn) return SCRIPT_ON;
  if (s->steps > 0) {
    --s->steps;
    if (!s->spun) push_motion(s->dx, s->dy, s->buttons);
    return SCRIPT_ON;
  }
  if (s->spun) {
    end_spin(s);
    return SCRIPT_ON;
  }
  s->at += strspn(s->at, "; ");
  char word[8] = "", key;
  int number, used = 0;
  if (*s->at == '\0') return SCRIPT_ON;
  sscanf(s->at, "%7[a-z]", word);
  const char* rest = s->at + strlen(word);
  const size_t length = strcspn(s->at, ";");
  int result = SCRIPT_ON;
  if (strcmp(word, "wait") == 0) {
    if (!is_finest) return SCRIPT_ON;
  } else if (sscanf(rest, " %d %d%n", &s->dx, &s->dy, &used) == 2 &&
             (strcmp(word, "drag") == 0 || strcmp(word, "pan") == 0)) {
    s->buttons = *word == 'd' ? SDL_BUTTON_LMASK : SDL_BUTTON_RMASK;
    s->dx /= DRAG_STEPS;
    s->dy /= DRAG_STEPS;
    s->steps = DRAG_STEPS;
  } else if (strcmp(word, "wheel") == 0 && sscanf(rest, " %d", &number) == 1) {
    push_wheel(number);
  } else if (strcmp(word, "spin") == 0 && sscanf(rest, " %d", &number) == 1 && number > 0) {
    s->steps = s->spun = number;
    s->began = SDL_GetPerformanceCounter();
    push_key(SDLK_SPACE);
  } else if (strcmp(word, "key") == 0 && sscanf(rest, " %c", &key) == 1) {
    push_key(key);
  } else if (strcmp(word, "shot") == 0 && length > 5 && length - 5 < room) {
    memcpy(file, s->at + 5, length - 5);
    file[length - 5] = '\0';
    result = SCRIPT_SHOT;
  } else if (strcmp(word, "quit") == 0) {
    push_quit();
  } else {
    fprintf(stderr, "viewer: no command of a script: %.*s\n", (int)length, s->at);
    return SCRIPT_ERROR;
  }
  s->at += length;
  return result;
}
