/* Loaded before a program: its OpenGL context is lost once the program has asked $ROWLAND_TEST_LOST_AFTER times whether
 * it is, and stays lost; or while the file $ROWLAND_TEST_LOST_WHEN is there, if that is set. It replaces
 * libepoxy's pointer to the driver's function. */
#include <stdlib.h>
#include <unistd.h>

#define GL_NO_ERROR 0u
#define GL_GUILTY_CONTEXT_RESET 0x8253u

static unsigned status(void) {
    static int asked = 0;
    const char* after = getenv("ROWLAND_TEST_LOST_AFTER");
    const char* when = getenv("ROWLAND_TEST_LOST_WHEN");
    if (when != NULL) return access(when, F_OK) == 0 ? GL_GUILTY_CONTEXT_RESET : GL_NO_ERROR;
    return ++asked > (after == NULL ? 0 : atoi(after)) ? GL_GUILTY_CONTEXT_RESET : GL_NO_ERROR;
}

unsigned (*epoxy_glGetGraphicsResetStatus)(void) = status;
